#include "planner/sketch/sketch_region.hpp"

#include <gtest/gtest.h>

#include "tests/unit/planner/sketch/strokes.hpp"

namespace aerogram::planner {
namespace {

using namespace testing;

double area_inside(const std::vector<SketchPath>& outlines) {
    double area = 0.0;
    for (const SketchPath& path : outlines) area += ClosedCurve(path.points).area();
    return area;
}

TEST(SketchRegion, InclusiveBoundariesEncloseAndExclusiveOnesTakeAway) {
    const SketchRegion ring({circle({0, 0}, 10), circle({0, 0}, 5, true)});
    EXPECT_TRUE(ring.contains({7, 0}));
    EXPECT_FALSE(ring.contains({3, 0}));
    EXPECT_FALSE(ring.contains({11, 0}));
}

TEST(SketchRegion, TheOrderOfStrokesDoesNotMatter) {
    Random random(7);
    const std::vector<SketchStroke> one{circle({0, 0}, 10), circle({1, 0}, 7, true), circle({1, 0}, 3),
                                        box({-12, -2}, {-6, 2}, true)};
    const std::vector<SketchStroke> other{one[3], one[2], one[1], one[0]};
    const SketchRegion a(one), b(other);
    for (int k = 0; k < 2000; ++k) {
        const Vec2 p(random.between(-13, 13), random.between(-13, 13));
        EXPECT_EQ(a.contains(p), b.contains(p)) << p.x << ' ' << p.y;
    }
}

TEST(SketchRegion, IslandsStandInHolesOfAnyDepth) {
    const SketchRegion target(
        {circle({0, 0}, 10), circle({0, 0}, 8, true), circle({0, 0}, 6), circle({0, 0}, 4, true), circle({0, 0}, 2)});
    for (const auto& [x, inside] : {std::pair(9.0, true), {7.0, false}, {5.0, true}, {3.0, false}, {1.0, true}})
        EXPECT_EQ(target.contains({x, 0.1}), inside) << x;
}

TEST(SketchRegion, AnExclusiveBoundaryAroundEverythingLeavesNothing) {
    const SketchRegion none({circle({0, 0}, 5), circle({0, 0}, 9, true)});
    EXPECT_FALSE(none.contains({1, 1}));
    EXPECT_TRUE(outlines_of(none).empty());
}

TEST(SketchRegion, BoundariesThatCrossAreOneOutline) {
    const auto outlines = outlines_of(SketchRegion({box({0, 8}, {20, 12}), box({8, 0}, {12, 20})}));
    ASSERT_EQ(outlines.size(), 1U);
    EXPECT_TRUE(outlines[0].closed);
    EXPECT_EQ(outlines[0].points.size(), 12U);
    EXPECT_NEAR(area_inside(outlines), 20 * 4 + 16 * 4, 1e-9);
    EXPECT_NEAR(length_of(outlines[0]), 80.0, 1e-9);
}

TEST(SketchRegion, AnExclusiveBoundaryAcrossTheEdgeBitesAPieceOff) {
    const auto outlines = outlines_of(SketchRegion({box({0, 0}, {10, 10}), box({5, 5}, {20, 20}, true)}));
    ASSERT_EQ(outlines.size(), 1U);
    EXPECT_NEAR(area_inside(outlines), 75.0, 1e-9);
    EXPECT_NEAR(length_of(outlines[0]), 40.0, 1e-9);
}

TEST(SketchRegion, BoundariesThatShareAnEdgeAreOneArea) {
    const auto outlines = outlines_of(SketchRegion({box({0, 0}, {10, 10}), box({10, 2}, {20, 8})}));
    EXPECT_NEAR(area_inside(outlines), 160.0, 1e-9);
    double length = 0.0;
    for (const auto& path : outlines) length += length_of(path);
    EXPECT_NEAR(length, 40.0 + 20.0, 1e-6);
}

TEST(SketchRegion, ALineDrawnTwiceIsDrawnOnce) {
    SketchStroke reversed = box({0, 0}, {10, 10});
    std::reverse(reversed.points.begin(), reversed.points.end());
    const auto outlines = outlines_of(SketchRegion({box({0, 0}, {10, 10}), reversed}));
    ASSERT_EQ(outlines.size(), 1U);
    EXPECT_NEAR(length_of(outlines[0]), 40.0, 1e-9);
}

TEST(SketchRegion, ACurveThatCrossesItselfEnclosesWhatItWindsRound) {
    const auto outlines = outlines_of(SketchRegion({{{{0, 0}, {20, 10}, {20, 0}, {0, 10}}, true, false}}));
    EXPECT_EQ(outlines.size(), 2U);
    EXPECT_NEAR(area_inside(outlines), 100.0, 1e-9);
}

// Oracle: the area by counting, and the area on the left of every chord.
TEST(SketchRegion, OutlinesGoRoundTheAreaOfEverySketch) {
    for (const NamedSketch& sketch : sketches()) {
        const SketchRegion region(sketch.strokes);
        const auto outlines = outlines_of(region);
        const Bounds box = region.bounds();
        const int cells = 400;
        double counted = 0.0;
        for (int y = 0; y < cells; ++y)
            for (int x = 0; x < cells; ++x)
                counted += region.contains(box.low + box.size() * (Vec2(x, y) + 0.5) / double(cells)) ? 1.0 : 0.0;
        counted *= box.size().x * box.size().y / (cells * cells);
        EXPECT_NEAR(area_inside(outlines), counted, 0.01 * box.size().x * box.size().y) << sketch.name;
        for (const SketchPath& path : outlines) {
            EXPECT_TRUE(path.closed) << sketch.name;
            for (std::size_t i = 0; i < path.points.size(); ++i) {
                const Vec2 a = path.points[i], b = path.points[(i + 1) % path.points.size()];
                const Vec2 aside = 1e-4 * Vec2(a.y - b.y, b.x - a.x);
                EXPECT_TRUE(region.contains(0.5 * (a + b) + aside)) << sketch.name;
                EXPECT_FALSE(region.contains(0.5 * (a + b) - aside)) << sketch.name;
            }
        }
    }
}

// Oracle: the angle sum of paper 002, appendix A.
TEST(ClosedCurve, ContainsWhatItsAngleSumSays) {
    Random random(3);
    for (int round = 0; round < 50; ++round) {
        Contour corners;
        for (int k = 0; k < 3 + round % 9; ++k) corners.emplace_back(random.between(-5, 5), random.between(-5, 5));
        const ClosedCurve curve(corners);
        for (int k = 0; k < 200; ++k) {
            const Vec2 p(random.between(-6, 6), random.between(-6, 6));
            double sum = 0.0;
            for (std::size_t i = 0; i < corners.size(); ++i) {
                const Vec2 a = corners[i] - p, b = corners[(i + 1) % corners.size()] - p;
                sum += std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b));
            }
            EXPECT_EQ(curve.contains(p), std::abs(sum) > 1.0) << round << ' ' << p.x << ' ' << p.y;
        }
    }
}

TEST(ClosedCurve, HoldsOnlyWhatIsWhollyInside) {
    const ClosedCurve frame(circle({0, 0}, 10).points);
    EXPECT_TRUE(frame.holds(ClosedCurve(circle({3, 0}, 6).points)));
    EXPECT_FALSE(frame.holds(ClosedCurve(circle({6, 0}, 6).points)));
    EXPECT_FALSE(frame.holds(ClosedCurve(circle({0, 0}, 20).points)));
    // All corners of the bar are inside the horseshoe, whose gap it crosses.
    const ClosedCurve horseshoe({{0, 0}, {10, 0}, {10, 10}, {6, 10}, {6, 4}, {4, 4}, {4, 10}, {0, 10}});
    EXPECT_FALSE(horseshoe.holds(ClosedCurve({{1, 6}, {9, 6}, {9, 8}, {1, 8}})));
    EXPECT_TRUE(horseshoe.holds(ClosedCurve({{1, 1}, {9, 1}, {9, 3}, {1, 3}})));
}

}  // namespace
}  // namespace aerogram::planner
