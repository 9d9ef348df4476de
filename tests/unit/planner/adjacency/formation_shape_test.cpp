#include "planner/adjacency/formation_shape.hpp"

#include <gtest/gtest.h>

#include "tests/unit/planner/adjacency/formations.hpp"

namespace aerogram::planner {
namespace {

using namespace testing;

TEST(FormationShape, DimensionOfEachKind) {
    EXPECT_EQ(shape_of(Points{{1, 2, 3}}).dimension, 0);
    EXPECT_EQ(shape_of(Points{{1, 2, 3}, {1, 2, 4}}).dimension, 1);
    EXPECT_EQ(shape_of(grid(9, 1, 2.0)).dimension, 1);
    EXPECT_EQ(shape_of(grid(9, 2, 2.0)).dimension, 2);
    EXPECT_EQ(shape_of(letter_n()).dimension, 2);
    EXPECT_EQ(shape_of(cube(2, 2.0)).dimension, 3);
}

TEST(FormationShape, GridIsMeasuredExactlyHoweverItIsTurned) {
    const Points points = Motion{{0.4, 1.3, -2.2}, {300, -200, 90}}(grid(9, 5, 2.0));
    const FormationShape shape = shape_of(points);
    EXPECT_EQ(shape.dimension, 2);
    EXPECT_NEAR(shape.spacing_m, 2.0, 1e-12);
    EXPECT_NEAR(shape.radius_m, std::hypot(8.0, 4.0), 1e-12);
    EXPECT_LT(shape.thickness_m, 1e-11);
    EXPECT_NEAR(glm::length(shape.center_m - Motion{{0.4, 1.3, -2.2}, {300, -200, 90}}(Vec3{8, 0, 4})), 0.0, 1e-11);
}

TEST(FormationShape, AxesAreOrthonormalAndWidestFirst) {
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
        Points points = random_points(40, seed);
        for (Vec3& p : points) p = Motion{{0.1, 0.2, static_cast<double>(seed)}, {}}(Vec3{9.0 * p.x, 3.0 * p.y, p.z});
        const FormationShape shape = shape_of(points);
        std::array<double, 3> variance{};
        for (std::size_t k = 0; k < 3; ++k) {
            for (std::size_t j = 0; j < 3; ++j)
                EXPECT_NEAR(glm::dot(shape.axes[k], shape.axes[j]), j == k ? 1.0 : 0.0, 1e-12);
            for (const Vec3& p : points) variance[k] += std::pow(glm::dot(p - shape.center_m, shape.axes[k]), 2);
        }
        EXPECT_GE(variance[0], variance[1]);
        EXPECT_GE(variance[1], variance[2]);
        double cross = 0.0;
        for (const Vec3& p : points)
            cross += glm::dot(p - shape.center_m, shape.axes[0]) * glm::dot(p - shape.center_m, shape.axes[2]);
        EXPECT_NEAR(cross, 0.0, 1e-10 * variance[0]) << "axes are not principal, seed " << seed;
    }
}

TEST(FormationShape, SpacingIsTheMedianOfNearestDistancesByBruteForce) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const Points points = random_points(31, seed);
        std::vector<double> nearest;
        for (const Vec3& p : points) {
            double best = 1e9;
            for (const Vec3& q : points)
                if (&p != &q) best = std::min(best, glm::length(p - q));
            nearest.push_back(best);
        }
        std::sort(nearest.begin(), nearest.end());
        EXPECT_EQ(shape_of(points).spacing_m, nearest[15]) << seed;
    }
}

TEST(SamePlace, ChainsOfNearPointsAreOnePlaceAndOthersAreNot) {
    const Points points{{10, 0, 0}, {0, 0, 0}, {0, 4e-6, 0}, {-10, 0, 0}, {0, 8e-6, 0}, {0, 1e-3, 0}};
    EXPECT_EQ(same_place(points), (std::vector<std::uint32_t>{0, 1, 1, 3, 1, 5}));
}

}  // namespace
}  // namespace aerogram::planner
