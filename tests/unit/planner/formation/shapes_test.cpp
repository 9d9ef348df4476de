#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "geo/units.hpp"
#include "planner/sampling/curve.hpp"
#include "planner/sampling/sphere_points.hpp"
#include "tests/unit/planner/formation/missions.hpp"

namespace aerogram::planner::testing {
namespace {

using ::testing::HasSubstr;

double smallest_gap(const Points& points) {
    return closest_pair(points, {}).distance_m;
}

TEST(Line, RunsAlongXFromLeftToRight) {
    const Points p = built(part_of(shape(ShapeKind::line), 5, wide(20))).points_m;
    for (std::size_t i = 0; i < p.size(); ++i)
        EXPECT_NEAR(glm::distance(p[i], Vec3(5.0 * static_cast<double>(i) - 10, 0, 0)), 0, 1e-12);
}

TEST(Line, WithoutASizeTakesTheSpacing) {
    const Points p = built(part_of(shape(ShapeKind::line), 6)).points_m;
    EXPECT_NEAR(box_of(p).size().x, 11.0, 1e-12);  // 5 x 2.2 m
}

TEST(Grid, FillsRowsFromTheTopLeftAndCentresAnIncompleteLastRow) {
    ShapeSource grid = shape(ShapeKind::grid);
    grid.columns = 4;
    const Points p = built(part_of(grid, 10, flat(9, 8))).points_m;
    EXPECT_NEAR(glm::distance(p[0], Vec3(-4.5, 0, 4)), 0, 1e-12);
    EXPECT_NEAR(glm::distance(p[3], Vec3(4.5, 0, 4)), 0, 1e-12);
    EXPECT_NEAR(glm::distance(p[8], Vec3(-1.5, 0, -4)), 0, 1e-12);
    EXPECT_NEAR(glm::distance(p[9], Vec3(1.5, 0, -4)), 0, 1e-12);
}

TEST(Grid, ChoosesTheRowsNearestToTheAspect) {
    const auto rows_of = [](const Points& points) {
        return std::count_if(points.begin(), points.end(), [&](const Vec3& p) { return p.x == points.front().x; });
    };
    EXPECT_EQ(rows_of(built(part_of(shape(ShapeKind::grid), 36)).points_m), 6);
    EXPECT_EQ(rows_of(built(part_of(shape(ShapeKind::grid), 24, flat(25, 15))).points_m), 4);  // 6 x 4, 5 m apart
    EXPECT_EQ(rows_of(built(part_of(shape(ShapeKind::grid), 24, flat(15, 25))).points_m), 6);
}

TEST(Grid, RowsAndColumnsThatDoNotSuitTheDronesAreAnError) {
    ShapeSource grid = shape(ShapeKind::grid);
    grid.rows = 2;
    grid.columns = 3;
    const auto tight = build(mission_of({part_of(grid, 7)}));
    ASSERT_FALSE(tight.ok());
    EXPECT_EQ(tight.error().message,
              "show.toml:7: keyframe[1]: a grid of rows = 2, columns = 3 does not suit 7 drones; "
              "columns = 3 needs rows = 3");
    grid.rows = 4;
    EXPECT_THAT(build(mission_of({part_of(grid, 7)})).error().message, HasSubstr("columns = 3 needs rows = 3"));
}

TEST(Circle, StartsAtTheTopAndGoesClockwise) {
    const Points p = built(part_of(shape(ShapeKind::circle), 8, flat(20, 20))).points_m;
    EXPECT_NEAR(glm::distance(p[0], Vec3(0, 0, 10)), 0, 1e-12);
    EXPECT_NEAR(glm::distance(p[2], Vec3(10, 0, 0)), 0, 1e-12);
    for (std::size_t i = 0; i < 8; ++i) EXPECT_NEAR(glm::distance(p[i], p[(i + 1) % 8]), 20 * std::sin(kPi / 8), 1e-12);
}

TEST(Circle, AnEllipseIsEquallySpacedAlongItself) {
    const Points p = built(part_of(shape(ShapeKind::circle), 40, flat(60, 30))).points_m;
    double low = 1e9, high = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const double gap = glm::distance(p[i], p[(i + 1) % p.size()]);
        low = std::min(low, gap);
        high = std::max(high, gap);
        EXPECT_NEAR(std::pow(p[i].x / 30, 2) + std::pow(p[i].z / 15, 2), 1.0, 1e-9);
    }
    EXPECT_LT(high / low, 1.02);  // chords of equal arcs
}

TEST(Helix, ClimbsEvenlyAroundZ) {
    ShapeSource helix = shape(ShapeKind::helix);
    helix.turns = 2;
    const Points p = built(part_of(helix, 33, {20, 20, 30})).points_m;
    EXPECT_NEAR(glm::distance(p[0], Vec3(10, 0, -15)), 0, 1e-12);
    EXPECT_NEAR(glm::distance(p[32], Vec3(10, 0, 15)), 0, 1e-9);
    EXPECT_NEAR(glm::distance(p[8], Vec3(-10, 0, -7.5)), 0, 1e-9);  // a quarter of the way: half a turn
    for (std::size_t i = 0; i + 1 < p.size(); ++i)
        EXPECT_NEAR(glm::distance(p[i], p[i + 1]), glm::distance(p[0], p[1]), 1e-9);
}

TEST(Helix, AnEllipticOneIsEquallySpacedAlongItself) {
    const Points p = built(part_of(shape(ShapeKind::helix), 120, {60, 30, 60})).points_m;
    double low = 1e9, high = 0;
    for (std::size_t i = 0; i + 1 < p.size(); ++i) {
        low = std::min(low, glm::distance(p[i], p[i + 1]));
        high = std::max(high, glm::distance(p[i], p[i + 1]));
    }
    EXPECT_LT(high / low, 1.02);
}

TEST(EquallySpaced, AStraightLineIsDividedExactly) {
    const Points p = equally_spaced([](double t) { return Vec3(t * t, 0, 0); }, 5, false);
    for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(p[i].x, 0.25 * static_cast<double>(i), 1e-6);
    EXPECT_EQ(equally_spaced([](double t) { return Vec3(t, 0, 0); }, 1, false).front(), Vec3(0.0));
}

TEST(SpreadOnEllipsoid, Property1PointsAreOnTheSurface) {
    const Vec3 radii(3, 5, 2);
    for (const Vec3& p : spread_on_ellipsoid(radii, 150, {})) EXPECT_NEAR(glm::length(p / radii), 1.0, 1e-12);
}

TEST(SpreadOnEllipsoid, Property2SmallestSpacingIsNearTheBestKnown) {
    // Smallest distances of the best known spherical codes, from the angles in Sloane's tables of packings on the
    // sphere.
    const std::pair<std::size_t, double> best_known[] = {{2, 2.0},     {3, 1.7320508}, {4, 1.6329932},  {6, 1.4142136},
                                                         {8, 1.2156},  {9, 1.1547005}, {12, 1.0514622}, {20, 0.8046},
                                                         {24, 0.7442}, {48, 0.5276}};
    for (const auto& [count, best] : best_known) {
        const double found = smallest_gap(spread_on_ellipsoid(Vec3(1.0), count, {}));
        EXPECT_LE(found, best * 1.0002) << count;
        EXPECT_GE(found, best * 0.97) << count;
    }
}

TEST(SpreadOnEllipsoid, Property2LargeCountsStayWithinATenthOfTheTriangularLattice) {
    const double lattice = std::sqrt(4 * kPi / 2000 * 2 / std::sqrt(3.0));
    EXPECT_GE(smallest_gap(spread_on_ellipsoid(Vec3(1.0), 2000, {})), 0.9 * lattice);
}

TEST(SpreadOnEllipsoid, Property3IsDeterministic) {
    EXPECT_EQ(spread_on_ellipsoid(Vec3(1, 2, 3), 77, {}), spread_on_ellipsoid(Vec3(1, 2, 3), 77, {}));
}

}  // namespace
}  // namespace aerogram::planner::testing
