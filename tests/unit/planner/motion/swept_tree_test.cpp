#include "planner/motion/swept_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "geo/random.hpp"

namespace aerogram::planner {
namespace {

/// Remembers every pair, with a fixed limit.
struct Collector {
    double limit = 0.0;
    std::multiset<std::pair<std::uint32_t, std::uint32_t>> pairs;

    [[nodiscard]] double limit_m() const { return limit; }
    void visit(std::uint32_t i, std::uint32_t j) { pairs.insert({i, j}); }
};

Points scattered(std::size_t n, double half_m, Random& random) {
    Points points(n);
    for (Vec3& p : points)
        p = {random.between(-half_m, half_m), random.between(-half_m, half_m), random.between(-half_m, half_m)};
    return points;
}

/// Distance of the segment [w, u] from the origin.
double apart_m(const Vec3& w, const Vec3& u) {
    const Vec3 way = u - w;
    const double squared = glm::dot(way, way);
    const double s = squared > 0.0 ? std::clamp(-glm::dot(w, way) / squared, 0.0, 1.0) : 0.0;
    return glm::length(w + s * way);
}

void expect_all_close_pairs(const Points& from, const Points& to, const std::vector<double>& strays, double limit_m,
                            const SweptTree& tree) {
    Collector found{limit_m, {}};
    tree.for_each_close_pair(found);
    for (std::uint32_t i = 0; i < from.size(); ++i) {
        for (std::uint32_t j = i + 1; j < from.size(); ++j) {
            const std::size_t times = found.pairs.count({i, j});
            EXPECT_LE(times, 1U);
            const double bound_m = apart_m(from[j] - from[i], to[j] - to[i]) - strays[i] - strays[j];
            if (bound_m < limit_m - 1e-9) {
                EXPECT_EQ(times, 1U) << i << ' ' << j << ' ' << bound_m;
            }
            if (bound_m > limit_m + 1e-9) {
                EXPECT_EQ(times, 0U) << i << ' ' << j << ' ' << bound_m;
            }
        }
    }
}

TEST(SweptTree, FindsThoseAndOnlyThosePairsThatComeClose) {
    Random random(41);
    for (int round = 0; round < 40; ++round) {
        const std::size_t n = random.below(130);
        const double half_m = random.between(1.0, 20.0);
        const Points from = scattered(n, half_m, random);
        Points to = from;
        for (std::size_t i = 0; i < n; ++i) {
            if (round % 3 == 0) to[i] = 2.0 * from[i] + Vec3{100, 0, 7};   // a sane map
            if (round % 3 == 1) to[i] = scattered(1, half_m, random)[0];   // a wild one
            if (round % 3 == 2 && i > 0 && i % 4 == 0) to[i] = to[i - 1];  // some land together
        }
        std::vector<double> strays(n);
        for (double& stray : strays) stray = random.between(0.0, 0.5);
        SweptTree tree(from, to);
        tree.place(from, to, strays);
        expect_all_close_pairs(from, to, strays, random.between(0.0, 4.0), tree);
    }
}

/// The order of one map serves another, though more slowly.
TEST(SweptTree, KeepsItsPromiseWhenPointsArePlacedElsewhere) {
    Random random(42);
    for (int round = 0; round < 20; ++round) {
        const Points from = scattered(90, 9.0, random), to = scattered(90, 9.0, random);
        SweptTree tree(scattered(90, 9.0, random), scattered(90, 9.0, random));
        tree.place(from, to, {});
        expect_all_close_pairs(from, to, std::vector<double>(90, 0.0), 1.5, tree);
    }
}

TEST(SweptTree, ALimitBelowZeroEndsTheSearch) {
    Random random(43);
    const Points points = scattered(50, 1.0, random);
    Collector found{-std::numeric_limits<double>::infinity(), {}};
    SweptTree(points, points).for_each_close_pair(found);
    EXPECT_TRUE(found.pairs.empty());
}

TEST(SweptTree, NoPointsAndOnePointHaveNoPairs) {
    Collector found{1e9, {}};
    SweptTree({}, {}).for_each_close_pair(found);
    const Points one = {{1, 2, 3}};
    SweptTree(one, one).for_each_close_pair(found);
    EXPECT_TRUE(found.pairs.empty());
}

}  // namespace
}  // namespace aerogram::planner
