#include "planner/text/baseline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "geo/units.hpp"
#include "planner/text/text_layout.hpp"

namespace aerogram::planner {
namespace {

constexpr double kHandle = 0.5522847498307936;  ///< of a quarter circle's cubic: off by less than 3e-4 radii

/// The upper half of a circle of radius 1, from left to right.
DrawnLine half_circle() {
    DrawnLine line;
    line.bezier = true;
    line.points = {{-1, 0}, {-1, kHandle}, {-kHandle, 1}, {0, 1}, {kHandle, 1}, {1, kHandle}, {1, 0}};
    return line;
}

TEST(Baseline, FollowsAHalfCircle) {
    const Baseline line = Baseline::of(half_circle(), 30.0).value();
    const double radius = 30.0 / kPi;
    for (const double x : {0.0, 1.0, 7.3, 15.0, 22.5, 30.0}) {
        const double turned = kPi * (1.0 - x / 30.0);
        const LetterFrame frame = line.at(x);
        EXPECT_NEAR(glm::distance(frame.at, radius * Vec2(std::cos(turned), std::sin(turned))), 0.0, 1e-3 * radius);
        EXPECT_NEAR(glm::distance(frame.right, Vec2(std::sin(turned), -std::cos(turned))), 0.0, 3e-3);
        EXPECT_NEAR(glm::length(frame.right), 1.0, 1e-12);
        // Heads point away from the middle.
        EXPECT_NEAR(glm::length(frame.place({x, 5.0}, x)), radius + 5.0, 1e-3 * radius);
    }
}

TEST(Baseline, IsAsLongAsTheTextAndOnlyItsShapeCounts) {
    DrawnLine line;
    line.points = {{0, 0}, {3, 0}, {3, 4}};
    const Baseline first = Baseline::of(line, 14.0).value();
    EXPECT_NEAR(glm::distance(first.at(13.0).at, Vec2(6, 7)), 0.0, 1e-12);
    EXPECT_NEAR(glm::distance(first.at(13.0).right, Vec2(0, 1)), 0.0, 1e-12);
    for (Vec2& p : line.points) p = 1e6 * p + Vec2(5e5, -7e5);
    const LetterFrame moved = Baseline::of(line, 14.0).value().at(13.0);
    EXPECT_NEAR(glm::distance(moved.at - first.at(13.0).at, 2e-6 * Vec2(5e5, -7e5)), 0.0, 1e-9);
}

TEST(Baseline, ClosedLinesGoRoundAndOpenOnesStraightOn) {
    DrawnLine line;
    line.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    line.closed = true;
    const Baseline square = Baseline::of(line, 40.0).value();
    EXPECT_NEAR(glm::distance(square.at(35.0).at, Vec2(0, 5)), 0.0, 1e-12);
    EXPECT_NEAR(glm::distance(square.at(45.0).at, square.at(5.0).at), 0.0, 1e-12);
    EXPECT_NEAR(glm::distance(square.at(-5.0).at, square.at(35.0).at), 0.0, 1e-12);
    line.closed = false;
    const Baseline open = Baseline::of(line, 30.0).value();
    EXPECT_NEAR(glm::distance(open.at(31.0).at, Vec2(-1, 10)), 0.0, 1e-12);
    EXPECT_NEAR(glm::distance(open.at(-1.0).at, Vec2(-1, 0)), 0.0, 1e-12);
}

TEST(Baseline, ALineWithoutLengthIsRefused) {
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    for (const std::vector<Vec2>& points :
         {std::vector<Vec2>{{1, 1}, {1, 1}}, {{2, 3}}, {}, {{0, 0}, {nan, 1}}, {{0, 0}, {1, infinity}}}) {
        DrawnLine line;
        line.points = points;
        const auto refused = Baseline::of(line, 10.0);
        ASSERT_FALSE(refused.ok());
        EXPECT_EQ(refused.error().message, "along: the line has no length");
    }
    DrawnLine dot;
    dot.bezier = true;
    dot.points = {{1, 1}, {1, 1}, {1, 1}, {1, 1}};
    EXPECT_FALSE(Baseline::of(dot, 10.0).ok());
}

TEST(StrokeText, LettersStandRigidlyAlongALine) {
    TextSource source;
    source.text = "HI H";
    const auto straight = stroke_text(source).value();
    source.along = half_circle();
    const auto bent = stroke_text(source).value();
    ASSERT_EQ(bent.size(), straight.size());
    for (std::size_t i = 0; i < bent.size(); ++i) {
        ASSERT_EQ(bent[i].size(), straight[i].size());
        const Vec2 a = bent[i].front().front(), b = straight[i].front().front();
        for (std::size_t s = 0; s < bent[i].size(); ++s) {
            for (std::size_t v = 0; v < bent[i][s].size(); ++v) {
                EXPECT_NEAR(glm::distance(bent[i][s][v], a), glm::distance(straight[i][s][v], b), 1e-9);
            }
        }
    }
    // The first letter leans back, the last one forward.
    const auto stem = [](const std::vector<Stroke>& letter) {
        const Vec2 d = letter.front().back() - letter.front().front();
        return d.y > 0.0 ? d : -d;
    };
    EXPECT_LT(stem(bent.front()).x, -5.0);
    EXPECT_GT(stem(bent.back()).x, 5.0);
}

TEST(StrokeText, SeveralLinesAlongOneAreRefused) {
    TextSource source;
    source.text = "A\nB";
    source.along = half_circle();
    EXPECT_EQ(stroke_text(source).error().message, "has 2 lines; along a line it must have one");
    source.text = " \n";
    EXPECT_EQ(stroke_text(source).error().message, "the text draws nothing");
}

}  // namespace
}  // namespace aerogram::planner
