#include "geo/units.hpp"
#include "planner/drawing/path.hpp"
#include "tests/unit/planner/drawing/drawings.hpp"

namespace aerogram::planner::testing {
namespace {

/// The line that path data draw, y up again as SVG writes it.
Stroke line_of(const std::string& data) {
    const DrawnShape shape = only_shape("<path fill='none' stroke='red' d='" + data + "'/>");
    EXPECT_EQ(shape.lines.size(), 1U) << data;
    Stroke line = shape.lines.empty() ? Stroke{} : shape.lines.front();
    for (Vec2& p : line) p.y = -p.y;
    return line;
}

void expect_line(const std::string& data, const Stroke& expected) {
    const Stroke line = line_of(data);
    ASSERT_EQ(line.size(), expected.size()) << data;
    for (std::size_t i = 0; i < line.size(); ++i)
        EXPECT_LT(glm::distance(line[i], expected[i]), 1e-9) << data << ' ' << i;
}

/// Both draw the same points.
void expect_same(const std::string& data, const std::string& absolute) {
    expect_line(data, line_of(absolute));
}

double distance_to(const Stroke& line, const Vec2& p) {
    double best = 1e300;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Vec2 d = line[i + 1] - line[i];
        const double t = std::clamp(glm::dot(p - line[i], d) / glm::dot(d, d), 0.0, 1.0);
        best = std::min(best, glm::distance(p, line[i] + t * d));
    }
    return best;
}

TEST(SvgPath, LinesAbsoluteRelativeHorizontalAndVertical) {
    expect_line("M10 20L30 40", {{10, 20}, {30, 40}});
    expect_line("M10,20,30,40 50 60", {{10, 20}, {30, 40}, {50, 60}});
    expect_line("m10 20 30 40", {{10, 20}, {40, 60}});
    expect_line("M10 20H50V70", {{10, 20}, {50, 20}, {50, 70}});
    expect_line("M10 20h5 6v7-2", {{10, 20}, {15, 20}, {21, 20}, {21, 27}, {21, 25}});
    expect_line("M1e1-2.5.5-.5l.5.25", {{10, -2.5}, {0.5, -0.5}, {1.0, -0.25}});
}

TEST(SvgPath, CloseReturnsToTheStartAndTheNextCommandBeginsThere) {
    const DrawnShape shape = only_shape("<path stroke='red' fill='none' d='M10 10h20v20zl-5-5'/>");
    ASSERT_EQ(shape.lines.size(), 2U);
    EXPECT_TRUE(shape.closed[0]);
    EXPECT_FALSE(shape.closed[1]);
    EXPECT_EQ(shape.lines[0].size(), 3U);
    EXPECT_LT(glm::distance(shape.lines[1][0], Vec2(10, -10)), 1e-12);
    EXPECT_LT(glm::distance(shape.lines[1][1], Vec2(5, -5)), 1e-12);
}

TEST(SvgPath, CubicsPassThroughTheirPointsAndRelativeAndSmoothOnesAgree) {
    const Stroke line = line_of("M10 80C40 10 65 10 95 80");
    for (const double t : {0.1, 0.25, 0.5, 0.8}) {
        const double u = 1 - t;
        const Vec2 p = u * u * u * Vec2(10, 80) + 3 * u * u * t * Vec2(40, 10) + 3 * u * t * t * Vec2(65, 10) +
                       t * t * t * Vec2(95, 80);
        EXPECT_LT(distance_to(line, p), 100.0 / 4000.0);
    }
    expect_same("M10 80c30-70 55-70 85 0", "M10 80C40 10 65 10 95 80");
    expect_same("M10 40C20 20 30 20 40 40S60 60 70 40", "M10 40C20 20 30 20 40 40C50 60 60 60 70 40");
    expect_same("M10 40C20 20 30 20 40 40s20 20 30 0", "M10 40C20 20 30 20 40 40C50 60 60 60 70 40");
    expect_same("M10 40S30 20 40 40", "M10 40C10 40 30 20 40 40");  // without a cubic before it
}

TEST(SvgPath, QuadraticsAreExactParabolas) {
    const Stroke line = line_of("M0 0Q50 100 100 0");
    for (const Vec2& p : line) EXPECT_NEAR(p.y, 2.0 * p.x * (100.0 - p.x) / 100.0, 1e-9);
    EXPECT_NEAR(distance_to(line, {50, 50}), 0.0, 100.0 / 4000.0);
    expect_same("M10 10q20 40 40 0", "M10 10Q30 50 50 10");
    expect_same("M10 10Q20 30 30 10T50 10", "M10 10Q20 30 30 10Q40-10 50 10");
    expect_same("M10 10q10 20 20 0t20 0", "M10 10Q20 30 30 10Q40-10 50 10");
    const Stroke straight = line_of("M10 10T50 10");  // no quadratic before it: its control is here
    EXPECT_LT(glm::distance(straight.back(), Vec2(50, 10)), 1e-12);
    for (const Vec2& p : straight) EXPECT_NEAR(p.y, 10.0, 1e-12);
}

TEST(SvgPath, ArcsLieOnTheirEllipseAndTurnAsTheirFlagsSay) {
    for (const bool large : {false, true}) {
        for (const bool sweep : {false, true}) {
            const std::string flags = std::string(large ? "1" : "0") + (sweep ? "1" : "0");
            const Stroke line = line_of("M50 30A20 20 0 " + flags + "70 50");
            const Vec2 centre = large == sweep ? Vec2(70, 30) : Vec2(50, 50);
            for (const Vec2& p : line) EXPECT_NEAR(glm::distance(p, centre), 20.0, 20 * 3e-4 + 0.025) << flags;
            const double quarter = 0.5 * kPi * 20.0;
            EXPECT_NEAR(length_of(line, false), large ? 3 * quarter : quarter, 0.3) << flags;
        }
    }
    expect_same("M50 30a20 20 0 0120 20", "M50 30A20 20 0 0 1 70 50");
    expect_same("M50 30a20 20 0 0 1 20 20a20 20 0 1 0-20-20", "M50 30A20 20 0 0 1 70 50A20 20 0 1 0 50 30");
}

TEST(SvgPath, TurnedEllipticalArcsObeyTheirEquation) {
    const double turn = radians(30.0);
    const Stroke line = line_of("M30 50A30 15 30 1 1 60 60");
    // The centre by another way: the two circles of radius 1 through both ends once the ellipse is made round.
    const auto round = [&](const Vec2& p) {
        return Vec2((p.x * std::cos(turn) + p.y * std::sin(turn)) / 30.0,
                    (p.y * std::cos(turn) - p.x * std::sin(turn)) / 15.0);
    };
    const Vec2 a = round({30, 50}), b = round({60, 60}), half = 0.5 * (b - a);
    const double rise = std::sqrt(1.0 - glm::dot(half, half));
    const Vec2 off = rise * glm::normalize(Vec2(-half.y, half.x));
    const auto worst = [&](const Vec2& centre) {
        double most = 0.0;
        for (const Vec2& p : line) most = std::max(most, std::abs(glm::distance(round(p), centre) - 1.0));
        return most;
    };
    EXPECT_LT(std::min(worst(0.5 * (a + b) + off), worst(0.5 * (a + b) - off)), 2e-3);
    EXPECT_GT(length_of(line, false), 80.0);  // the large one
}

TEST(SvgPath, ArcsWithTooSmallRadiiGrowAndWithoutRadiusAreLines) {
    const Stroke line = line_of("M20 50A1 1 0 0 1 60 50");
    for (const Vec2& p : line) EXPECT_NEAR(glm::distance(p, Vec2(40, 50)), 20.0, 0.03);
    expect_line("M20 50A0 5 0 0 1 60 50", {{20, 50}, {60, 50}});
    expect_line("M20 50A5 5 0 0 1 20 50L30 50", {{20, 50}, {30, 50}});
}

TEST(SvgPath, WrongDataDrawWhatCameBeforeAndWarn) {
    const Drawing drawing = drawing_of("<path stroke='red' fill='none' d='M10 10L20 20L30 oops'/>");
    ASSERT_EQ(drawing.shapes.size(), 1U);
    EXPECT_EQ(drawing.shapes[0].lines[0].size(), 2U);
    EXPECT_EQ(all_warnings(drawing), "line 2: path data stop making sense; the path is drawn up to there\n");
}

TEST(SvgShapes, AreasAndLengthsAreThoseOfTheirFormulas) {
    EXPECT_NEAR(area_of(only_shape("<rect x='10' y='20' width='30' height='40'/>").area), 1200.0, 1e-9);
    EXPECT_NEAR(area_of(only_shape("<rect width='40' height='40' rx='10'/>").area), 1600 - (4 - kPi) * 100, 1.5);
    EXPECT_NEAR(area_of(only_shape("<rect width='40' height='20' rx='50' ry='50'/>").area), kPi * 20 * 10, 2.5);
    EXPECT_NEAR(area_of(only_shape("<circle cx='50' cy='50' r='30'/>").area), kPi * 900, 12.0);
    EXPECT_NEAR(area_of(only_shape("<ellipse cx='50' cy='50' rx='30' ry='10'/>").area), kPi * 300, 4.0);
    EXPECT_NEAR(area_of(only_shape("<polygon points='0,0 40 0 40,30'/>").area), 600.0, 1e-9);
    EXPECT_NEAR(area_of(only_shape("<polyline points='0,0 40 0 40,30'/>").area), 600.0, 1e-9);  // a fill closes it
    const DrawnShape line = only_shape("<line x1='10' y1='10' x2='40' y2='50' stroke='red'/>");
    EXPECT_NEAR(length_of(line.lines[0], false), 50.0, 1e-12);
    EXPECT_FALSE(line.fill.has_value());
}

TEST(SvgShapes, UnitsAndPercentages) {
    const auto box = [](const std::string& inside) { return bounds_of(only_shape(inside).area).size(); };
    EXPECT_NEAR(box("<rect width='50%' height='25%'/>").x, 50.0, 1e-9);
    EXPECT_NEAR(box("<rect width='50%' height='25%'/>").y, 25.0, 1e-9);
    EXPECT_NEAR(box("<rect width='0.5in' height='1cm'/>").x, 48.0, 1e-9);
    EXPECT_NEAR(box("<rect width='0.5in' height='1cm'/>").y, 96.0 / 2.54, 1e-9);
    EXPECT_NEAR(box("<rect width='10mm' height='12pt'/>").y, 16.0, 1e-9);
    EXPECT_NEAR(box("<rect width='1em' height='2pc'/>").y, 32.0, 1e-9);
}

TEST(SvgShapes, OnesWithoutExtentAreNotDrawn) {
    EXPECT_EQ(message_of(page("<rect width='0' height='9'/><circle r='0'/><path d='M3 3'/><polygon points='4'/>")),
              "line 1: draws nothing that can be shown");
}

}  // namespace
}  // namespace aerogram::planner::testing
