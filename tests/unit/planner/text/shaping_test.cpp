#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "planner/text/outline_font.hpp"

/// Glyphs, places and order against what HarfBuzz's own program says of the same fonts (Debian 12's packages
/// fonts-hosny-amiri 0.113, fonts-lohit-deva 2.95.4, fonts-ipafont-gothic 00303, fonts-symbola 2.60, fonts-dejavu-core
/// 2.37; libharfbuzz-bin 6.0):
///     hb-shape --no-glyph-names --no-clusters --language=und FONT TEXT
namespace aerogram::planner {
namespace {

using ::testing::ElementsAre;
using ::testing::ElementsAreArray;
using ::testing::HasSubstr;

FontData font_called(const std::string& name) {
    return load_font(installed_font(name).value()).value();
}

Result<ShapedText> shaped(const std::string& font, std::string_view line) {
    return shape_text(font_called(font), std::array{line});
}

using Row = std::tuple<std::uint32_t, double, double>;  // glyph, x, y

/// Glyph, advance, offset as hb-shape prints them, as places in a line.
struct Printed {
    std::uint32_t glyph;
    double advance, dx = 0.0, dy = 0.0;
};
std::vector<Row> placed(const std::vector<Printed>& printed) {
    std::vector<Row> out;
    double pen = 0.0;
    for (const Printed& p : printed) {
        out.emplace_back(p.glyph, pen + p.dx, p.dy);
        pen += p.advance;
    }
    return out;
}
std::vector<Row> line_of(const std::string& font, std::string_view text) {
    const auto done = shaped(font, text);
    if (!done) throw std::runtime_error(done.error().message);
    std::vector<Row> out;
    for (const PlacedGlyph& g : done->lines.front().glyphs) out.emplace_back(g.glyph, g.at.x, g.at.y);
    return out;
}
std::vector<std::uint32_t> glyphs_of(const std::string& font, std::string_view text) {
    std::vector<std::uint32_t> out;
    for (const Row& row : line_of(font, text)) out.push_back(std::get<0>(row));
    return out;
}

// These fail without HarfBuzz: no table from characters to glyphs alone has joined forms, marks or conjuncts.
TEST(HarfBuzz, JoinsArabicFromRightToLeft) {
    EXPECT_THAT(line_of("Amiri", "سلام"),
                ElementsAreArray(placed({{421, 452}, {3588, 446}, {3583, 245}, {2411, 568}})));
}

TEST(HarfBuzz, PutsArabicMarksOnTheirLetters) {
    EXPECT_THAT(line_of("Amiri", "السَّلامُ"), ElementsAreArray(placed({{431, 0, -83, 0},
                                                                     {421, 452},
                                                                     {3588, 446},
                                                                     {3583, 245},
                                                                     {1927, 0, 236, 51},
                                                                     {433, 0, 36, 0},
                                                                     {2422, 568},
                                                                     {2335, 175},
                                                                     {391, 217}})));
}

TEST(HarfBuzz, MakesDevanagariConjunctsAndMovesVowelsBeforeTheirSyllable) {
    EXPECT_THAT(line_of("Lohit Devanagari", "क्षि"), ElementsAreArray(placed({{707, 266}, {520, 657}})));
    EXPECT_THAT(line_of("Lohit Devanagari", "नमस्ते"),
                ElementsAreArray(placed({{345, 585}, {351, 579}, {557, 523}, {341, 608}, {376, 0, -8, 0}})));
    EXPECT_THAT(
        line_of("Lohit Devanagari", "हिन्दी र्क"),
        ElementsAreArray(placed(
            {{368, 266}, {362, 527}, {541, 394}, {343, 541}, {369, 266}, {3, 316}, {326, 749}, {513, 0, -297, 0}})));
}

TEST(HarfBuzz, KnowsJapaneseAndEmojiAndLatinLigatures) {
    EXPECT_THAT(line_of("IPAGothic", "東京タワー"),
                ElementsAreArray(placed({{2929, 2048}, {1443, 2048}, {710, 2048}, {758, 2048}, {415, 2048}})));
    EXPECT_THAT(line_of("DejaVu Sans", "AVfi"), ElementsAreArray(placed({{36, 1270}, {57, 1401}, {5042, 1290}})));
    // Selectors and joiners draw nothing, and are not missed in a font without them.
    EXPECT_THAT(line_of("Symbola", "☀️🎆"), ElementsAreArray(placed({{3483, 2048}, {3, 0}, {8140, 2056}})));
    EXPECT_THAT(line_of("Symbola", "👨‍👩"), ElementsAreArray(placed({{8366, 2048}, {3, 0}, {8367, 2048}})));
}

// Expected orders by hand from Unicode's annex 9; the words themselves are shaped as above.
TEST(MixedDirections, EachWordRunsItsOwnWayInALineThatRunsAsItsFirstWord) {
    const auto glyphs = [](std::string_view text) { return glyphs_of("DejaVu Sans", text); };
    const auto joined = [](std::initializer_list<std::vector<std::uint32_t>> parts) {
        std::vector<std::uint32_t> out;
        for (const auto& part : parts) out.insert(out.end(), part.begin(), part.end());
        return out;
    };
    const auto salam = glyphs("سلام"), paris = glyphs("Paris"), year = glyphs("2026"), space = glyphs(" ");
    EXPECT_EQ(glyphs("Paris سلام 2026"), joined({paris, space, year, space, salam}));
    EXPECT_EQ(glyphs("سلام Paris 2026"), joined({paris, space, year, space, salam}));
    EXPECT_EQ(glyphs("2026 سلام Paris"), joined({paris, space, salam, space, year}));
    // Brackets are mirrored with their text.
    EXPECT_EQ(glyphs("سلام (Paris)"), joined({glyphs("("), paris, glyphs(")"), space, salam}));
    EXPECT_EQ(glyphs("(سلام)"), joined({glyphs("("), salam, glyphs(")")}));
    // A mark that only says in which direction to run (U+200F) makes the line run from right to left.
    const auto forced = glyphs("\u200FParis سلام");
    EXPECT_THAT(forced, ::testing::Not(ElementsAreArray(joined({paris, space, salam}))));
    ASSERT_GT(forced.size(), salam.size());
    EXPECT_TRUE(std::equal(salam.begin(), salam.end(), forced.begin()));
}

TEST(MixedDirections, LinesRunEachTheirOwnWay) {
    const std::array<std::string_view, 2> lines{"سلام Paris", "Paris سلام"};
    const auto text = shape_text(font_called("DejaVu Sans"), lines).value();
    EXPECT_EQ(text.lines[0].glyphs.back().glyph, glyphs_of("DejaVu Sans", "سلام").back());
    EXPECT_EQ(text.lines[1].glyphs.front().glyph, glyphs_of("DejaVu Sans", "Paris").front());
    EXPECT_NEAR(text.lines[0].width, text.lines[1].width, 1e-9);
}

TEST(ShapedLetters, HoldTheirMarksAndLigaturesAndTileTheLine) {
    for (const auto& [font, text, letters] :
         {std::tuple("Amiri", "السَّلامُ", 6U), {"Lohit Devanagari", "नमस्ते", 4U}, {"DejaVu Sans", "AVfi", 3U}}) {
        const ShapedLine line = shaped(font, text)->lines.front();
        EXPECT_EQ(line.letters.size(), letters) << text;
        double at = 0.0;
        std::size_t glyph = 0;
        for (const ShapedLetter& letter : line.letters) {
            EXPECT_EQ(letter.begin, glyph);
            EXPECT_NEAR(letter.left, at, 1e-9);
            glyph = letter.end;
            at = letter.right;
        }
        EXPECT_EQ(glyph, line.glyphs.size());
        EXPECT_NEAR(at, line.width, 1e-9);
    }
}

TEST(ShapedText, AMissingCharacterIsNamedByItsCodePoint) {
    const auto message = [](const std::string& font, std::string_view text) {
        const auto done = shaped(font, text);
        return done ? "shaped" : done.error().message;
    };
    EXPECT_THAT(message("DejaVu Sans", "A\u6F22"), HasSubstr("character \"\u6F22\" (U+6F22) is not in the font"));
    EXPECT_THAT(message("DejaVu Sans", "A\u6F22"), HasSubstr("the installed font \"IPAGothic\" has it"));
    // The mark of a letter that the font has.
    EXPECT_THAT(message("Lohit Devanagari", "नq\u0301"), HasSubstr("(U+0301) is not in the font"));
    EXPECT_THAT(message("DejaVu Sans", "\U000F1234"), HasSubstr("(U+F1234) is not in the font"));
    EXPECT_THAT(message("DejaVu Sans", "\U000F1234"), HasSubstr("; no installed font has it"));
    EXPECT_THAT(message("DejaVu Sans", "a\tb"), HasSubstr("character U+0009 is not in the font"));
}

TEST(ShapedText, WhatIsNotUtf8IsRefused) {
    for (const std::string bad : {"A\xE2\x82", "A\x80", "A\xC0\xAF", "A\xED\xA0\x80", "A\xF4\x90\x80\x80", "A\xFF"}) {
        const auto done = shaped("DejaVu Sans", bad);
        ASSERT_FALSE(done.ok());
        EXPECT_EQ(done.error().message, "is not UTF-8 at byte 2");
    }
}

}  // namespace
}  // namespace aerogram::planner
