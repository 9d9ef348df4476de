#include <gtest/gtest.h>

#include <limits>

#include "geo/contract.hpp"
#include "planner/sampling/closest_pair.hpp"
#include "tests/unit/planner/sampling/random.hpp"

namespace aerogram::planner::testing {
namespace {

/// All pairs; the first of equal ones.
ClosestPair by_brute_force(const Points& points, const SeparationMetric& metric) {
    ClosestPair best{0, 0, std::numeric_limits<double>::infinity()};
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (std::size_t j = i + 1; j < points.size(); ++j) {
            const double distance = metric.distance(points[i], points[j]);
            if (distance < best.distance_m) best = {i, j, distance};
        }
    }
    return best;
}

void expect_same(const Points& points, const SeparationMetric& metric) {
    const ClosestPair found = closest_pair(points, metric), wanted = by_brute_force(points, metric);
    EXPECT_EQ(found.distance_m, wanted.distance_m);
    EXPECT_EQ(found.first, wanted.first);
    EXPECT_EQ(found.second, wanted.second);
}

TEST(ClosestPair, RandomPointsAgreeWithBruteForceExactly) {
    constexpr std::uint64_t kSeed = 11;
    SCOPED_TRACE(kSeed);
    Random random(kSeed);
    for (std::size_t round = 0; round < cases(300); ++round) {
        const std::size_t n = 2 + random.below(120);
        const double flatness = random.below(2) == 0 ? 0.0 : 1.0;
        Points points;
        for (std::size_t i = 0; i < n; ++i) points.push_back(random.point(50.0) * Vec3(1.0, flatness, 1.0));
        expect_same(points, {random.between(1.0, 4.0)});
    }
}

TEST(ClosestPair, ClustersFarApartAgreeWithBruteForce) {
    constexpr std::uint64_t kSeed = 12;
    SCOPED_TRACE(kSeed);
    Random random(kSeed);
    Points points;
    for (std::size_t i = 0; i < 600; ++i) {
        const double far = static_cast<double>(i % 3) * 1e5;
        points.push_back(Vec3(far, 0, 0) + random.point(i % 3 == 0 ? 1e-3 : 1.0));
    }
    expect_same(points, {1.0});
}

TEST(ClosestPair, EqualDistancesGiveTheLowestNumbers) {
    Points grid;
    for (int row = 0; row < 9; ++row) {
        for (int column = 0; column < 9; ++column) grid.emplace_back(2.0 * column, 0.0, 2.0 * row);
    }
    const ClosestPair pair = closest_pair(grid, {});
    EXPECT_EQ(pair.distance_m, 2.0);
    EXPECT_EQ(pair.first, 0U);
    EXPECT_EQ(pair.second, 1U);
}

TEST(ClosestPair, DownwashMakesHeightCountLess) {
    const Points points{{0, 0, 0}, {1.5, 0, 0}, {0, 0, 2.0}};
    EXPECT_EQ(closest_pair(points, {1.0}).second, 1U);
    const ClosestPair squeezed = closest_pair(points, {2.0});
    EXPECT_EQ(squeezed.second, 2U);
    EXPECT_EQ(squeezed.distance_m, 1.0);
}

TEST(ClosestPair, CoincidentPointsAreFound) {
    expect_same({{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {4, 5, 6}, {1, 2, 3}}, {1.0});
    expect_same(Points(5, Vec3(3, 3, 3)), {1.0});
}

TEST(ClosestPair, FewerThanTwoPointsOrNotFiniteOnesAreABug) {
    EXPECT_THROW(static_cast<void>(closest_pair({{0, 0, 0}}, {})), ContractViolation);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(static_cast<void>(closest_pair({{0, 0, 0}, {nan, 0, 0}}, {})), ContractViolation);
}

TEST(ClosestPair, TwentyThousandPointsAgreeWithAGridOfKnownSpacing) {
    Points points;
    for (int i = 0; i < 20000; ++i) points.emplace_back(3.0 * (i % 200), 3.0 * (i / 200), 0.25 * (i % 7));
    points[12345].x += 1.25;  // towards its neighbour on the right
    const ClosestPair pair = closest_pair(points, {});
    EXPECT_EQ(pair.first, 12345U);
    EXPECT_EQ(pair.second, 12346U);
    EXPECT_NEAR(pair.distance_m, glm::distance(points[12345], points[12346]), 0.0);
}

}  // namespace
}  // namespace aerogram::planner::testing
