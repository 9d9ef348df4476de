#include "planner/transition/turn.hpp"

#include <gtest/gtest.h>

#include "geo/units.hpp"
#include "tests/unit/planner/transition/shapes.hpp"

namespace aerogram::planner {
namespace {

using namespace testing;

Mat3 matrix_of(const Turn& t) {
    return Mat3{{turned(t, 1.0, {1, 0, 0}), turned(t, 1.0, {0, 1, 0}), turned(t, 1.0, {0, 0, 1})}};
}

TEST(Turn, QuarterAboutZTakesXToY) {
    const Turn quarter{{0, 0, 1}, kPi / 2};
    EXPECT_LT(glm::distance(turned(quarter, 1.0, {1, 0, 0}), Vec3(0, 1, 0)), 1e-15);
    EXPECT_LT(glm::distance(turned(quarter, 2.0, {1, 0, 5}), Vec3(-1, 0, 5)), 1e-15);
    EXPECT_LT(glm::distance(turned(quarter.inverse(), 1.0, {1, 0, 0}), Vec3(0, -1, 0)), 1e-15);
}

TEST(Turn, MatrixAndBackForAllAngles) {
    const int count = tries(300);
    for (int seed = 1; seed <= count; ++seed) {
        SCOPED_TRACE(seed);
        Random random(static_cast<std::uint64_t>(seed));
        double angle = random.between(0.0, kPi);
        if (seed % 5 == 0) angle = std::pow(10.0, random.between(-12.0, -3.0));
        if (seed % 5 == 1) angle = kPi - std::pow(10.0, random.between(-12.0, -3.0));
        const Turn turn{random.direction(), angle};
        const Turn back = turn_of(matrix_of(turn));
        EXPECT_NEAR(back.angle_rad, angle, 1e-14);
        const Vec3 v = random.in_cube(10.0);
        EXPECT_LT(glm::distance(turned(back, 1.0, v), turned(turn, 1.0, v)), 1e-13);
        if (angle < kPi - 1e-6) {
            EXPECT_LT(glm::distance(turned(back, 0.5, v), turned(turn, 0.5, v)), 1e-8);
        }
    }
    EXPECT_EQ(turn_of(Mat3{}).angle_rad, 0.0);
    EXPECT_TRUE(is_half_turn(turn_of(Mat3{{Vec3{-1, 0, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1}}})));
}

TEST(Turn, SingularValuesRebuildMatricesOfAnyRank) {
    const int count = tries(200);
    for (int seed = 1; seed <= count; ++seed) {
        SCOPED_TRACE(seed);
        Random random(static_cast<std::uint64_t>(seed));
        Mat3 m = zero3();
        for (int rank = 0; rank < seed % 4; ++rank) m.add_outer(random.in_cube(3.0), random.in_cube(3.0));
        const Svd3 svd = singular_values(m);
        Mat3 rebuilt = zero3();
        for (std::size_t i = 0; i < 3; ++i) rebuilt.add_outer(svd.values[i] * svd.u.columns[i], svd.v.columns[i]);
        for (std::size_t i = 0; i < 3; ++i) EXPECT_LT(glm::distance(rebuilt.columns[i], m.columns[i]), 1e-13);
        EXPECT_GE(svd.values[0], svd.values[1]);
        EXPECT_GE(svd.values[1], svd.values[2]);
        for (std::size_t i = static_cast<std::size_t>(seed % 4); i < 3; ++i) EXPECT_LT(svd.values[i], 1e-13);
    }
}

TEST(Turn, PrincipalAxesAreRightHandedAndOrdered) {
    Points box;
    for (int i = 0; i < 8; ++i) box.push_back({(i & 1 ? 1 : -1) * 2.0, (i & 2 ? 1 : -1) * 5.0, (i & 4 ? 1 : -1) * 3.0});
    const PrincipalAxes p = principal_axes(box);
    EXPECT_NEAR(std::abs(p.axes.columns[0].y), 1.0, 1e-15);
    EXPECT_NEAR(std::abs(p.axes.columns[1].z), 1.0, 1e-15);
    EXPECT_NEAR(p.moments[2], 8 * 4.0, 1e-12);
    EXPECT_NEAR(glm::dot(glm::cross(p.axes.columns[0], p.axes.columns[1]), p.axes.columns[2]), 1.0, 1e-15);
}

TEST(Turn, ShortestTurnArrivesAndOppositeOnesTurnAboutTheHint) {
    Random random(5);
    for (int i = 0; i < 50; ++i) {
        const Vec3 a = random.direction(), b = random.direction();
        EXPECT_LT(glm::distance(turned(shortest_turn(a, b, {0, 0, 1}), 1.0, a), b), 1e-14);
    }
    const Turn about = shortest_turn({1, 0, 0}, {-1, 0, 0}, {5, 0, 2});
    EXPECT_LT(glm::distance(about.axis, Vec3(0, 0, 1)), 1e-15);
    EXPECT_EQ(about.angle_rad, kPi);
    EXPECT_EQ(shortest_turn({1, 0, 0}, {1, 0, 0}, {0, 0, 1}).angle_rad, 0.0);
}

TEST(Turn, SquareToFallsBackToShowYThenX) {
    EXPECT_EQ(square_to({0, 0, 1}, {0, 0, 3}), Vec3(0, 1, 0));
    EXPECT_EQ(square_to({0, 1, 0}, {0, 3, 0}), Vec3(1, 0, 0));
    EXPECT_EQ(square_to({0, 1, 0}, {0, 3, 4}), Vec3(0, 0, 1));
}

}  // namespace
}  // namespace aerogram::planner
