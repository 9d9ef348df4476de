#include "planner/adjacency/dual.hpp"

#include <gtest/gtest.h>

#include "tests/unit/planner/adjacency/formations.hpp"

namespace aerogram::planner {
namespace {

using namespace testing;

TEST(DualLength, SquareSideAndDiagonal) {
    const Vec2 a{0, 0}, b{2, 0}, c{2, 2}, d{0, 2};
    EXPECT_DOUBLE_EQ(dual_length_m(a, c, std::vector{b, d}, 50.0), 0.0);
    EXPECT_DOUBLE_EQ(dual_length_m(a, b, std::vector{c}, 50.0), 51.0);  // from the centre, 1 m inside, outwards
    EXPECT_DOUBLE_EQ(dual_length_m(a, b, {}, 50.0), 100.0);
}

TEST(DualLength, TwoTrianglesByClosedForm) {
    // Circumcentres of the triangles over and under the edge: (0, (t² - 1) / 2t) for an apex at height t.
    const double over = (9.0 - 1.0) / 6.0, under = -(4.0 - 1.0) / 4.0;
    EXPECT_NEAR(dual_length_m({-1, 0}, {1, 0}, std::vector<Vec2>{{0, 3}, {0, -2}}, 50.0), over - under, 1e-14);
}

TEST(DualWidth, CubeFaceOfALatticeEdgeIsASquareAndDiagonalsHaveNone) {
    // Edge along z, eight neighbours round it in a cubic lattice of 2 m: the Voronoi face is a 2 m square, 2·4/8 = 1.
    const Vec3 p{0, 0, 0}, q{0, 0, 2};
    std::vector<Vec3> ring;
    for (const double z : {0.0, 2.0})
        for (const Vec2& d : {Vec2{2, 0}, Vec2{-2, 0}, Vec2{0, 2}, Vec2{0, -2}}) ring.emplace_back(d.x, d.y, z);
    EXPECT_NEAR(dual_width_m(p, q, ring, 50.0), 1.0, 1e-12);
    EXPECT_NEAR(
        dual_width_m({0, 0, 0}, {2, 0, 2}, std::vector<Vec3>{{2, 0, 0}, {0, 0, 2}, {0, 2, 0}, {0, -2, 0}}, 50.0), 0.0,
        1e-12);
}

TEST(DualProperty1, RigidMotionsLeaveItAlone) {
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        const Points points = random_points(8, seed);
        const std::vector<Vec3> ring(points.begin() + 2, points.end());
        const Motion motion{{0.1 * static_cast<double>(seed), 0.7, -0.4}, {31, -17, 55}};
        const Points moved = motion(points);
        const std::vector<Vec3> moved_ring(moved.begin() + 2, moved.end());
        const double width = dual_width_m(points[0], points[1], ring, 100.0);
        EXPECT_NEAR(dual_width_m(moved[0], moved[1], moved_ring, 100.0), width, 1e-9 * (1.0 + width)) << seed;
    }
}

// Brute force: centres on a fine raster of the bisecting plane whose ball through the pair holds no ring point.
TEST(DualProperty2, NoWidthMeansNoEmptyBall) {
    std::size_t with = 0, without = 0;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        const Points ring = random_points(14, seed, 2.0);
        const Vec3 p{-1, 0, 0}, q{1, 0, 0};
        bool found = false;
        for (double y = -10.0; y <= 10.0; y += 0.05)
            for (double z = -10.0; z <= 10.0 && !found; z += 0.05) {
                bool empty = true;
                for (const Vec3& r : ring)
                    empty = empty && glm::length(r - Vec3{0, y, z}) >= std::sqrt(1.0 + y * y + z * z);
                found = empty;
            }
        const double width = dual_width_m(p, q, ring, 7.0);
        if (width == 0.0) {
            ++without;
        } else {
            ++with;
        }
        if (width > 0.2) {
            EXPECT_TRUE(found) << seed;
        }
        if (!found) {
            EXPECT_LT(width, 0.2) << seed;
        }
    }
    EXPECT_GT(with, 10U);
    EXPECT_GT(without, 10U);
}

}  // namespace
}  // namespace aerogram::planner
