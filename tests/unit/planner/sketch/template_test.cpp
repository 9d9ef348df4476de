#include "planner/sketch/sketch_template.hpp"

#include <gtest/gtest.h>

#include "planner/sampling/boundary_count.hpp"
#include "planner/sampling/push_apart.hpp"
#include "planner/sketch/boundary_points.hpp"
#include "planner/sketch/flood_fill.hpp"
#include "tests/unit/planner/sketch/strokes.hpp"

namespace aerogram::planner {
namespace {

using namespace testing;

bool stands_on(const std::vector<Vec2>& points, const Vec2& place) {
    return std::any_of(points.begin(), points.end(), [&](const Vec2& p) { return glm::distance(p, place) < 1e-9; });
}

TEST(BoundaryPoints, CornersAreKeptAndStepsAreEqual) {
    const auto paths = paths_of(SketchRegion({box({0, 0}, {20, 10})}), {});
    const auto points = resampled(paths, 2.1);
    EXPECT_EQ(points.size(), 30U);  // 10 and 5 steps of 2 m
    for (const Vec2& corner : {Vec2(0, 0), Vec2(20, 0), Vec2(20, 10), Vec2(0, 10)})
        EXPECT_TRUE(stands_on(points, corner));
    EXPECT_NEAR(smallest_distance(points), 2.0, 1e-9);
}

TEST(BoundaryPoints, Property1And2_OnThePathsAndApart) {
    for (const NamedSketch& sketch : sketches()) {
        const auto paths = paths_of(SketchRegion(sketch.strokes), sketch.strokes);
        for (const double unit : {0.3, 1.0, 2.7, 30.0}) {
            const auto points = resampled(paths, unit);
            EXPECT_GE(smallest_distance(points), 0.7 * unit) << sketch.name << ' ' << unit;
            for (const Vec2& p : points) EXPECT_LT(distance_to(paths, p), 1e-9) << sketch.name << ' ' << unit;
        }
    }
}

TEST(BoundaryPoints, Property1_ExactlyAsManyAsAskedFor) {
    for (const NamedSketch& sketch : sketches()) {
        const auto paths = paths_of(SketchRegion(sketch.strokes), sketch.strokes);
        for (std::size_t n = 1; n <= 130; ++n) {
            const auto points = resampled_exactly(paths, n);
            ASSERT_EQ(points.size(), n) << sketch.name;
            for (const Vec2& p : points) EXPECT_LT(distance_to(paths, p), 1e-9) << sketch.name << ' ' << n;
        }
    }
}

TEST(BoundaryPoints, FewPointsKeepTheEndsOfOpenLinesAndTheSharpestCorners) {
    const std::vector<SketchPath> wedge{{{{0, 0}, {10, 0}, {4, 3}, {4, 10}}, false}};  // sharp at (10, 0)
    const auto points = resampled_exactly(wedge, 3);
    EXPECT_TRUE(stands_on(points, {0, 0}));
    EXPECT_TRUE(stands_on(points, {10, 0}));
    EXPECT_TRUE(stands_on(points, {4, 10}));
}

// Oracle: every place of the lattice, asked by itself.
TEST(FloodFill, Property1And2_FindsAllPlacesOfAllRegions) {
    for (const NamedSketch& sketch : sketches()) {
        const SketchRegion region(sketch.strokes);
        const auto boundary = resampled(paths_of(region, sketch.strokes), 0.9);
        const Filled filled = flood_filled(region, boundary, 0.9, 0.7);
        std::vector<bool> found(filled.lattice.across * filled.lattice.up, false);
        for (const std::size_t cell : filled.cells) {
            EXPECT_FALSE(found[cell]) << "twice";
            found[cell] = true;
        }
        for (std::size_t row = 0; row < filled.lattice.up; ++row) {
            for (std::size_t column = 0; column < filled.lattice.across; ++column) {
                const Vec2 p = filled.lattice.at(column, row);
                bool wanted = region.contains(p);
                for (const Vec2& b : boundary) wanted = wanted && glm::distance(b, p) >= 0.7;
                EXPECT_EQ(found[row * filled.lattice.across + column], wanted) << sketch.name;
            }
        }
    }
}

TEST(FloodFill, AnAbsurdUnitIsMadeWiderInsteadOfFillingTheMemory) {
    const SketchRegion region({box({0, 0}, {10, 10})});
    const Filled filled = flood_filled(region, {{0, 0}}, 1e-9, 1e-3);
    EXPECT_LE(filled.lattice.across * filled.lattice.up, 4'000'000U);
    EXPECT_GT(filled.points.size(), 1'000'000U);
}

TEST(SamplingUnit, EquationTwoCorrectedHoldsForKnownCounts) {
    // n = b + r² b² with r = sqrt(f') / b'.
    for (const double b : {3.0, 40.0, 500.0}) {
        for (const double r : {1e-6, 0.1, 0.3}) {
            const double boundary = 200.0, inside = r * r * boundary * boundary;
            EXPECT_NEAR(boundary_count(b + r * r * b * b, boundary, inside), b, 1e-9 * b);
        }
    }
}

TEST(SketchTemplate, HoldsEverybodyAndNoMoreOnTheBoundaryThanThereAre) {
    for (const NamedSketch& sketch : sketches()) {
        const SketchRegion region(sketch.strokes);
        const auto paths = paths_of(region, sketch.strokes);
        for (const std::size_t n : {1U, 2U, 3U, 5U, 8U, 13U, 40U, 100U, 257U, 1000U}) {
            for (const std::optional<double> unit : {std::optional<double>{}, {0.05}, {1.0}, {50.0}}) {
                const SketchTemplate t = make_template(region, paths, n, {.unit = unit});
                EXPECT_GE(t.points.size(), n) << sketch.name;
                EXPECT_LE(t.boundary, n) << sketch.name;
                EXPECT_GE(t.boundary, 1U) << sketch.name;
                EXPECT_LE(t.points.size(), n + 20 + n / 2) << sketch.name << ' ' << n;
            }
        }
    }
}

TEST(SketchTemplate, BoundaryAndInsideLookEquallyDense) {
    // A disc of radius 10: length 2 pi 10, area 100 pi; equations 1 and 2 with what places near the boundary cost.
    const std::vector<SketchStroke> strokes{circle({0, 0}, 10)};
    const SketchRegion region(strokes);
    const SketchTemplate t = make_template(region, paths_of(region, strokes), 400, {.p = 0.85});
    const double inside_spacing = std::sqrt(kPi * 100.0 / 400.0);
    EXPECT_NEAR(t.unit, 0.85 * inside_spacing, 0.1 * inside_spacing);
    EXPECT_NEAR(static_cast<double>(t.boundary), 2.0 * kPi * 10.0 / t.unit, 2.0);
}

TEST(SketchTemplate, SmallerPMeansMoreOnTheBoundary) {
    const std::vector<SketchStroke> strokes{circle({0, 0}, 10)};
    const SketchRegion region(strokes);
    const auto at = [&](double p) { return make_template(region, paths_of(region, strokes), 400, {.p = p}).boundary; };
    EXPECT_GT(at(0.8), at(0.9));
    EXPECT_GT(at(0.9), at(1.0));
}

TEST(SketchTemplate, AUnitThatSuitsIsKeptAndOneThatDoesNotIsTold) {
    const std::vector<SketchStroke> strokes{box({0, 0}, {20, 20})};
    const SketchRegion region(strokes);
    const auto paths = paths_of(region, strokes);
    const SketchTemplate kept = make_template(region, paths, 100, {.unit = 2.0});
    EXPECT_EQ(kept.unit, 2.0);
    EXPECT_EQ(kept.boundary, 40U);
    EXPECT_FALSE(kept.unit_changed);
    EXPECT_TRUE(make_template(region, paths, 100, {.unit = 0.1}).unit_changed);  // 800 on the boundary alone
    EXPECT_TRUE(make_template(region, paths, 400, {.unit = 2.0}).unit_changed);  // 121 places in all
}

TEST(SketchTemplate, ADensityPutsMorePlacesWhereItIsHigher) {
    const std::vector<SketchStroke> strokes{box({0, 0}, {40, 20})};
    const SketchRegion region(strokes);
    TemplateOptions options;
    options.density = [](const Vec2& p) { return p.x < 20.0 ? 1.0 : 4.0; };
    const SketchTemplate t = make_template(region, paths_of(region, strokes), 1000, options);
    double left = 0.0, right = 0.0;
    for (std::size_t k = t.boundary; k < t.points.size(); ++k) ++(t.points[k].x < 20.0 ? left : right);
    EXPECT_NEAR(right / left, 4.0, 0.6);
    EXPECT_GE(t.points.size(), 1000U);
}

}  // namespace
}  // namespace aerogram::planner
