#include "planner/motion/neighbours.hpp"

#include <gtest/gtest.h>

#include "geo/random.hpp"

namespace aerogram::planner {
namespace {

/// Each pair at most once, the close ones exactly once.
void expect_close_pairs(const Points& points, double cell_m) {
    const std::size_t n = points.size();
    std::vector<int> seen(n * n, 0);
    NeighbourGrid(points, cell_m).for_each_pair([&](std::size_t i, std::size_t j) {
        ASSERT_LT(i, j);
        ++seen[i * n + j];
    });
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = i + 1; j < n; ++j) {
            EXPECT_LE(seen[i * n + j], 1);
            if (glm::length(points[i] - points[j]) <= cell_m) {
                EXPECT_EQ(seen[i * n + j], 1);
            }
        }
    }
}

TEST(NeighbourGrid, FindsEveryClosePairOnce) {
    Random random(77);
    for (int round = 0; round < 20; ++round) {
        Points points(200);
        for (Vec3& p : points) p = {random.between(-20, 20), random.between(-20, 20), random.between(-4, 4)};
        expect_close_pairs(points, 1.7);
    }
}

/// Clusters that are millions of cells apart on every axis: the empty cells between them do not count.
TEST(NeighbourGrid, FindsClosePairsInClustersFarApart) {
    Random random(78);
    Points points;
    for (int cluster = 0; cluster < 6; ++cluster) {
        const Vec3 middle{random.between(-1e7, 1e7), random.between(-1e7, 1e7), random.between(-1e7, 1e7)};
        for (int i = 0; i < 30; ++i) {
            points.push_back(middle + Vec3{random.between(-2, 2), random.between(-2, 2), random.between(-2, 2)});
        }
    }
    expect_close_pairs(points, 0.8);
}

TEST(NeighbourGrid, OfNoPointsAndOfCoincidentOnes) {
    expect_close_pairs({}, 1.0);
    expect_close_pairs(Points(20, Vec3{3, 4, 5}), 1.0);
}

}  // namespace
}  // namespace aerogram::planner
