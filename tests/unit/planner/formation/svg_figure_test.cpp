#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>

#include "geo/random.hpp"
#include "planner/formation/figure.hpp"
#include "planner/formation/svg_ink.hpp"
#include "tests/unit/planner/formation/missions.hpp"

namespace aerogram::planner::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// A drawing of 100 x 100 units in a file of the test's own.
fs::path drawn(const std::string& name, const std::string& inside) {
    const fs::path folder = fs::path(::testing::TempDir()) / "aerogram-svg-figure";
    fs::create_directories(folder);
    const fs::path file = folder / (name + ".svg");
    std::ofstream(file) << "<svg viewBox='0 0 100 100'>" << inside << "</svg>";
    return file;
}

SvgSource svg(const fs::path& file, SvgStyle style = SvgStyle::drawn) {
    SvgSource source;
    source.files = {file};
    source.style = style;
    return source;
}

Figure figure(const SvgSource& source, std::size_t drones, Size size = {}) {
    const Mission mission = mission_of({part_of(source, drones, size)});
    auto made = svg_figure({mission, mission.keyframes[0].parts[0], "keyframe[1]"}, source, Run{});
    EXPECT_TRUE(made.ok()) << (made ? "" : made.error().message);
    return made ? std::move(*made) : Figure{};
}

std::string fault(const SvgSource& source, Size size = {}) {
    const Mission mission = mission_of({part_of(source, 10, size)});
    const auto made = svg_figure({mission, mission.keyframes[0].parts[0], "keyframe[1]"}, source, Run{});
    EXPECT_FALSE(made.ok());
    return made ? std::string() : made.error().message;
}

double nearest(const Points& points) {
    double best = 1e300;
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) best = std::min(best, glm::distance(points[i], points[j]));
    }
    return best;
}

std::size_t of_color(const Figure& f, const std::string& hex) {
    return static_cast<std::size_t>(
        std::count_if(f.colors.begin(), f.colors.end(), [&](const Rgb& c) { return hex_from_rgb(c) == hex; }));
}

constexpr const char* kFlag =
    "<rect x='10' y='10' width='80' height='60' fill='#00f'/><circle cx='50' cy='40' r='20' fill='#ff0'/>"
    "<path d='M10 85H90' fill='none' stroke='#f00' stroke-width='2'/>";

/// A fill of no area made the spacing shrink without end.
TEST(SvgFigure, FillsWithoutAnAreaAreLeftOut) {
    const char* needle = "<path d='M10 10L60 35L90 50Z' fill='#f00'/>";
    EXPECT_THAT(fault(svg(drawn("needle", needle))), HasSubstr("shows nothing that is lit"));
    const Figure f = figure(svg(drawn("needle-and-disc", std::string(needle) + kFlag)), 40);
    EXPECT_EQ(f.points(Vec3(1.0)).size(), 40U);
    EXPECT_THAT(f.note, HasSubstr("fills without an area are left out"));
}

/// A staircase of 120,000 steps and a polygon that crosses itself everywhere kept Clipper busy for minutes.
TEST(SvgFigure, FillsTooInvolvedAreLeftOutInTime) {
    std::string stairs = "M0 0", tangle = "M50 50";
    for (int i = 0; i < 60'000; ++i) stairs += "l.001 0 0 .001";
    Random random(5);
    for (int i = 0; i < 20'000; ++i)
        tangle += "L" + std::to_string(random.between(0, 100)) + " " + std::to_string(random.between(0, 100));
    for (const std::string& path : {stairs, tangle}) {
        const std::string fill = "<path fill='#f00' d='" + path + "z'/>";
        EXPECT_THAT(fault(svg(drawn("involved", fill))), HasSubstr("too involved to be drawn are left out"));
        EXPECT_EQ(figure(svg(drawn("involved-and-flag", fill + kFlag)), 40).points(Vec3(1.0)).size(), 40U);
    }
}

/// Drones of filled drawings stood in their holes and beyond their edges.
TEST(SvgFigure, DronesStandOnTheRingNotInItsHole) {
    const fs::path file = drawn("frame", "<path fill='#f00' d='M0 0H100V100H0ZM20 20V80H80V20Z'/>");
    for (const std::size_t n : {16U, 30U, 60U, 300U, 1000U}) {
        const Figure f = figure(svg(file), n);
        const double spacing = std::sqrt(6400.0 / static_cast<double>(n));
        for (const Vec3& p : f.points(Vec3(1.0))) {
            const double out = std::max(std::abs(p.x), std::abs(p.z));
            EXPECT_LT(out, 50.0 + 0.2 * spacing) << n;
            EXPECT_GT(out, 30.0 - 0.2 * spacing) << n;
        }
    }
}

TEST(SvgFigure, EveryCountIsExactInEveryStyle) {
    const fs::path file = drawn("flag", kFlag);
    for (const SvgStyle style : {SvgStyle::drawn, SvgStyle::outline, SvgStyle::fill}) {
        for (const std::size_t n : {1U, 2U, 3U, 4U, 5U, 7U, 10U, 33U, 100U, 1000U}) {
            const Figure f = figure(svg(file, style), n);
            EXPECT_EQ(f.points(Vec3(1.0)).size(), n);
            EXPECT_EQ(f.points(Vec3(2.0, 1.0, 3.0)).size(), n);
        }
    }
}

TEST(SvgFigure, TwentyThousandDronesAreExact) {
    const Figure f = figure(svg(drawn("flag", kFlag)), 20'000);
    EXPECT_EQ(f.points(Vec3(1.0)).size(), 20'000U);
    EXPECT_EQ(f.colors.size(), 20'000U);
}

TEST(SvgFigure, DrawnSharesDronesByLengthAndAreaAtOneSpacing) {
    const Figure f = figure(svg(drawn("flag", kFlag)), 500);
    const Points points = f.points(Vec3(1.0));
    const double disc = 3.14159265 * 400, sheet = 4800.0 - disc;
    EXPECT_NEAR(static_cast<double>(of_color(f, "#ffff00")) / static_cast<double>(of_color(f, "#0000ff")), disc / sheet,
                0.15);
    const double spacing = 80.0 / (static_cast<double>(of_color(f, "#ff0000")) - 1.0);
    EXPECT_NEAR(spacing, std::sqrt(4800.0 / 480.0), 0.6);
    EXPECT_GT(nearest(points), 0.7 * spacing);
    EXPECT_NEAR(f.extent.x, 80.0, 1e-9);
}

TEST(SvgFigure, WhatLaterShapesHideGetsNoDrones) {
    const Figure f = figure(svg(drawn("flag", kFlag)), 400);
    const Points points = f.points(Vec3(1.0));
    const double low = 0.5 * (10.0 + 85.0);  // the middle of what is drawn, y down; half a spacing is 1.8
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double off = std::hypot(points[i].x, points[i].z - (low - 40.0));
        if (hex_from_rgb(f.colors[i]) == "#0000ff") {
            EXPECT_GT(off, 18.2);
        }
        if (hex_from_rgb(f.colors[i]) == "#ffff00") {
            EXPECT_LT(off, 21.9);
        }
    }
    const Figure hidden =
        figure(svg(drawn("hidden",
                         "<path d='M20 20h5' stroke='red'/><circle cx='50' cy='50' r='9' fill='lime'/>"
                         "<rect width='100' height='100' fill='blue'/>")),
               50);
    EXPECT_EQ(of_color(hidden, "#0000ff"), 50U);
}

TEST(SvgFigure, LinesAreStoodUponWithTheirEndsAndCorners) {
    const Figure f = figure(svg(drawn("corner", "<path d='M10 90V10H90' fill='none' stroke='red'/>")), 17);
    const Points points = f.points(Vec3(1.0));
    EXPECT_NEAR(nearest(points), 10.0, 1e-6);
    for (const Vec3& wanted : {Vec3(-40, 0, -40), Vec3(-40, 0, 40), Vec3(40, 0, 40)}) {
        const bool met =
            std::any_of(points.begin(), points.end(), [&](const Vec3& p) { return glm::distance(p, wanted) < 1e-6; });
        EXPECT_TRUE(met);
    }
}

TEST(SvgFigure, CrossingLinesOfOtherColoursKeepTheSpacing) {
    const Figure f = figure(
        svg(drawn("cross", "<g fill='none'><path d='M0 50H100' stroke='red'/><path d='M50 0V100' stroke='lime'/></g>")),
        40);
    EXPECT_GT(nearest(f.points(Vec3(1.0))), 0.7 * 200.0 / 40.0);
    const Figure one =
        figure(svg(drawn("cross1", "<g fill='none' stroke='red'><path d='M0 50H100'/><path d='M50 0V100'/></g>")), 41);
    EXPECT_NEAR(nearest(one.points(Vec3(1.0))), 5.0, 0.01);
}

TEST(SvgFigure, OutlineAndFillAreOfTheUnionWithItsHoles) {
    const std::string two = "<rect x='10' y='10' width='50' height='50'/><rect x='40' y='40' width='50' height='50'/>";
    const Points around = figure(svg(drawn("two", two), SvgStyle::outline), 80).points(Vec3(1.0));
    for (const Vec3& p : around) EXPECT_FALSE(std::abs(p.x) < 9.0 && std::abs(p.z) < 9.0);  // the overlap's lines
    const std::string ring = "<path fill-rule='evenodd' d='M0 0H90V90H0ZM30 30H60V60H30Z' fill='#0f0'/>";
    const Points filled = figure(svg(drawn("ring", ring), SvgStyle::fill), 300).points(Vec3(1.0));
    for (const Vec3& p : filled) EXPECT_FALSE(std::abs(p.x) < 14.5 && std::abs(p.z) < 14.5);
}

TEST(SvgFigure, FillIsColouredByPlaceAndThePaletteReduces) {
    SvgSource source = svg(drawn("flag", kFlag), SvgStyle::fill);
    const Figure f = figure(source, 300);
    const Points points = f.points(Vec3(1.0));
    const auto colors = f.colors_at(points);
    const double low = 0.5 * (10.0 + 86.0);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double off = std::hypot(points[i].x, points[i].z - (low - 40.0));
        if (off < 18.0) {
            EXPECT_EQ(hex_from_rgb(colors[i]), "#ffff00");
        }
        if (off > 22.0 && points[i].z > -20.0) {
            EXPECT_EQ(hex_from_rgb(colors[i]), "#0000ff");
        }
    }
    source.palette = 1;
    auto few = figure(source, 300).colors_at(points);
    EXPECT_TRUE(std::all_of(few.begin(), few.end(), [&](const Rgb& c) { return c == few.front(); }));
}

TEST(SvgInk, PaperIsLeftOutAndBlackIsLit) {
    const auto ink = [](const std::string& inside) {
        return ink_of(*parse_svg("<svg viewBox='0 0 100 100'>" + inside + "</svg>"));
    };
    const std::string paper = "<rect width='100' height='100' fill='white'/>";
    const Ink on_paper = ink(paper + "<circle cx='50' cy='50' r='9' fill='red'/>");
    EXPECT_EQ(on_paper.layers.size(), 1U);
    EXPECT_EQ(on_paper.note, "the white page is left out");
    EXPECT_EQ(ink(paper).layers.size(), 1U);  // alone it is the drawing
    const Ink badge = ink("<circle cx='50' cy='50' r='40'/><circle cx='50' cy='50' r='9' fill='white'/>");
    EXPECT_EQ(hex_from_rgb(badge.layers[0].color), "#ffffff");
    EXPECT_TRUE(badge.layers[1].dark);
    EXPECT_EQ(visible(badge).layers.size(), 1U);
    const Ink mixed =
        ink("<rect width='9' height='9'/><rect x='20' width='9' height='9' fill='red'/>"
            "<rect x='40' width='9' height='9' fill='white'/>");
    EXPECT_FALSE(mixed.layers[2].dark);
    EXPECT_LT(mixed.layers[0].color.r, 0.2);
    EXPECT_EQ(mixed.note, "black is lit dim");
}

TEST(SvgFigure, MoreShapesThanDronesAreOneArea) {
    std::string dots;
    for (int i = 0; i < 400; ++i) {
        dots += "<circle r='1.5' fill='red' cx='" + std::to_string(i % 20 * 5) + "' cy='" + std::to_string(i / 20 * 5) +
                "'/>";
    }
    const Figure f = figure(svg(drawn("dots", dots)), 50);
    const Points points = f.points(Vec3(1.0));
    EXPECT_EQ(points.size(), 50U);
    EXPECT_GT(nearest(points), 5.0);  // spread over all of them
    EXPECT_THAT(f.note, HasSubstr("has more shapes than drones: shown as one area"));
}

TEST(SvgFigure, WarningsOfTheReaderAreTheNote) {
    const Figure f = figure(svg(drawn("words", "<text>Hi</text><circle r='9' fill='red'/>")), 5);
    EXPECT_THAT(f.note, HasSubstr("line 1: text is not drawn"));
    EXPECT_THAT(fault(svg("no-such.svg")), HasSubstr("show.toml:7: keyframe[1].svg = \"no-such.svg\": cannot be read"));
    EXPECT_THAT(fault(svg(drawn("broken", "<g>"))), HasSubstr("line 1:"));
}

SvgSource frame(const std::vector<fs::path>& files, std::size_t index) {
    SvgSource source;
    source.files = files;
    source.frame = AnimationFrame{index, files.size(), {}};
    return source;
}

TEST(SvgFrames, ShapesKeepTheirDronesAndPlacesFollow) {
    const auto face = [](const std::string& name, int mouth) {
        return drawn(name, "<circle id='left' cx='30' cy='30' r='8' fill='#0f0'/><circle id='right' cx='" +
                               std::to_string(70 + mouth) +
                               "' cy='30' r='8' fill='#00f'/><path id='mouth' fill='none' "
                               "stroke='#f00' d='M20 70Q50 " +
                               std::to_string(70 + mouth) + " 80 70'/>");
    };
    const std::vector<fs::path> files{face("f1", 5), face("f2", 15), face("f3", 25)};
    const Figure first = figure(frame(files, 0), 60, high(50));
    Points before = first.points(Vec3(1.0));
    EXPECT_EQ(first.extent, Vec3(100, 0, 100));
    for (std::size_t k = 1; k < 3; ++k) {
        const Figure next = figure(frame(files, k), 60, high(50));
        const Points now = next.points(Vec3(1.0));
        EXPECT_EQ(next.colors, first.colors);
        for (std::size_t i = 0; i < now.size(); ++i) {
            const double most = hex_from_rgb(first.colors[i]) == "#00ff00" ? 6.0 : 14.0;
            EXPECT_LT(glm::distance(now[i], before[i]), most) << k << ' ' << i;
        }
        before = now;
    }
}

TEST(SvgFrames, ShapesThatComeOrGoAndOtherPagesAreErrors) {
    const fs::path one = drawn("a1", "<circle id='sun' r='9' fill='red'/><circle id='moon' cx='50' r='9' fill='red'/>");
    const fs::path less = drawn("a2", "<circle id='sun' r='9' fill='red'/>");
    EXPECT_THAT(fault(frame({one, less}, 1), high(9)), HasSubstr("the shape \"moon\" of"));
    EXPECT_THAT(fault(frame({less, one}, 1), high(9)), HasSubstr("the shape \"moon\" is not to be seen in"));
    EXPECT_THAT(fault(frame({one, one}, 1)), HasSubstr("keyframe[1].size_m: an animation needs a size"));
    const fs::path other = fs::path(less).replace_filename("other.svg");
    std::ofstream(other) << "<svg viewBox='0 0 50 100'><circle id='sun' r='9' fill='red'/></svg>";
    EXPECT_THAT(fault(frame({less, other}, 1), high(9)), HasSubstr("need the same viewBox"));
}

}  // namespace
}  // namespace aerogram::planner::testing
