#include "tests/unit/planner/drawing/drawings.hpp"

namespace aerogram::planner::testing {
namespace {

std::string repeated(const std::string& what, std::size_t times) {
    std::string out;
    out.reserve(what.size() * times);
    for (std::size_t i = 0; i < times; ++i) out += what;
    return out;
}

TEST(SvgHostile, WhatIsNotWellFormedIsRefusedWithItsLine) {
    EXPECT_EQ(message_of(""), "line 1: holds no element: not an SVG file");
    EXPECT_EQ(message_of("plain words"), "line 1: holds no element: not an SVG file");
    EXPECT_EQ(message_of("<svg>\n<g>\n"), "line 3: the file ends inside an element");
    EXPECT_EQ(message_of("<svg>\n<rect width=5/></svg>"), "line 2: the value of an attribute needs quotes");
    EXPECT_EQ(message_of("<svg>\n<rect width='5/></svg>"), "line 2: the file ends inside the value of an attribute");
    EXPECT_EQ(message_of("<svg>\n\n<rect width/></svg>"), "line 3: an attribute needs the form name=\"value\"");
    EXPECT_EQ(message_of("<svg><!-- "), "line 1: the file ends inside a comment");
    EXPECT_EQ(message_of("<svg>\n<a></g></svg>"), "line 2: not well-formed: invalid closing tag name");
    EXPECT_EQ(message_of("<svg/></svg>"), "line 1: a closing tag without its opening tag");
    EXPECT_EQ(message_of("<html></html>"), "line 1: the file's element is <html>, not <svg>");
    EXPECT_EQ(message_of(std::string("<svg>\0</svg>", 12)), "line 1: is not UTF-8 text: byte 6 is 0");
    EXPECT_EQ(message_of("<!DOCTYPE svg [ <!ENTITY a 'b'> "), "line 1: the file ends inside <! ... >");
}

TEST(SvgHostile, DeepNestingIsRefusedBeforeAnythingRecurses) {
    EXPECT_EQ(message_of(repeated("<g>\n", 1'000'000)), "line 257: elements nest deeper than 256");
    EXPECT_EQ(message_of("<svg>" + repeated("<g>", 300) + repeated("</g>", 300) + "</svg>"),
              "line 1: elements nest deeper than 256");
    const auto fits =
        parse_svg("<svg>" + repeated("<g>", 250) + "<rect width='9' height='9'/>" + repeated("</g>", 250) + "</svg>");
    EXPECT_TRUE(fits.ok());
}

TEST(SvgHostile, UseMayNotShowItselfNorMultiplyWithoutEnd) {
    EXPECT_EQ(message_of(page("<g id='a'>\n<use href='#a'/></g>")), "line 3: <use> shows \"a\", which holds it");
    EXPECT_EQ(message_of(page("<g id='a'><use href='#b'/></g>\n<g id='b'><use href='#a'/></g>")),
              "line 2: <use> shows \"b\", which shows itself");
    std::string bomb = "<defs><path id='u0' d='M0 0h1v1z'/>";
    for (int k = 1; k <= 9; ++k) {
        bomb += "<g id='u" + std::to_string(k) + "'>" + repeated("<use href='#u" + std::to_string(k - 1) + "'/>", 10) +
                "</g>";
    }
    EXPECT_EQ(message_of(page(bomb + "</defs><use href='#u9'/>")),
              "line 2: more than 1000000 path segments; simplify the drawing");
    std::string empty = "<defs><g id='u0'/>";
    for (int k = 1; k <= 9; ++k) {
        empty += "<g id='u" + std::to_string(k) + "'>" + repeated("<use href='#u" + std::to_string(k - 1) + "'/>", 10) +
                 "</g>";
    }
    EXPECT_EQ(message_of(page(empty + "</defs><use href='#u9'/>")), "line 2: more than 2000000 elements after <use>");
    std::string chain = "<defs><rect id='u0' width='9' height='9'/>";
    for (int k = 1; k <= 300; ++k) {
        chain += "<use id='u" + std::to_string(k) + "' href='#u" + std::to_string(k - 1) + "'/>";
    }
    EXPECT_EQ(message_of(page(chain + "</defs><use href='#u300'/>")),
              "line 2: elements nest deeper than 256 with <use>");
}

TEST(SvgHostile, AHundredThousandPathsAreRead) {
    std::string many;
    for (int i = 0; i < 100'000; ++i) {
        many += "<path d='M" + std::to_string(i % 300) + ' ' + std::to_string(i / 300) + "c1 0 1 1 0 1z'/>";
    }
    const auto drawing = parse_svg(page(many));
    ASSERT_TRUE(drawing.ok());
    EXPECT_EQ(drawing->shapes.size(), 100'000U);
}

TEST(SvgHostile, AMillionAndOneSegmentsAreRefused) {
    EXPECT_EQ(message_of(page("<path d='M0 0" + repeated("h1", 1'000'001) + "'/>")),
              "line 2: more than 1000000 path segments; simplify the drawing");
    EXPECT_EQ(message_of(page("\n<path d='M0 0h1e300'/>")), "line 3: coordinates beyond 1e12");
}

TEST(SvgHostile, CurvesOfAllTooManyPointsAreRefused) {
    const std::string loops = repeated("c9e9 9e9-9e9 9e9 1 1", 100'000);
    EXPECT_NE(message_of(page("<path d='M0 0" + loops + "'/>")).find("need more than 8000000 points"),
              std::string::npos);
}

TEST(SvgHostile, AnEvenOddScribbleFallsBackToNonzeroAndSaysSo) {
    std::string scribble = "<path fill-rule='evenodd' d='M0 0";
    for (std::size_t i = 0; i < 50'000; ++i)
        scribble += 'L' + std::to_string((i * 7919) % 997) + ' ' + std::to_string((i * 104729) % 991);
    const Drawing drawing = drawing_of(scribble + "'/>");
    EXPECT_EQ(all_warnings(drawing),
              "line 2: an even-odd path crosses itself too often; it is filled by the nonzero rule\n");
}

TEST(SvgHostile, StyleSheetsOfManyRulesForManyElementsAreBounded) {
    const std::string rules = "<style>" + repeated(".a{fill:red}", 20'000) + "</style>";
    EXPECT_NE(message_of(page(rules + repeated("<rect class='a' width='9' height='9'/>", 20'000)))
                  .find("too many style rules"),
              std::string::npos);
}

TEST(SvgHostile, EveryCutOfADrawingIsReadOrRefused) {
    const std::string whole = page(
        "<style>.a{fill:red}</style><g transform='rotate(3)'><path class='a' d='M1 2c3 4 5 6 7 8a1 2 3 0 1 4 5z'/></g>"
        "<!-- x --><![CDATA[ y ]]><use href='#q' x='1em'/>");
    for (std::size_t n = 0; n < whole.size(); ++n) {
        const auto drawing = parse_svg(std::string_view(whole).substr(0, n));
        if (drawing) continue;
        EXPECT_TRUE(drawing.error().message.starts_with("line ")) << drawing.error().message;
    }
}

}  // namespace
}  // namespace aerogram::planner::testing
