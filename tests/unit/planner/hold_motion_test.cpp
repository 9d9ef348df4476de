#include "planner/hold_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geo/random.hpp"

namespace aerogram::planner {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

Points cloud(std::uint64_t seed, std::size_t n) {
    Random random(seed);
    Points out;
    for (std::size_t i = 0; i < n; ++i)
        out.emplace_back(random.between(-30, 30), random.between(-30, 30), random.between(10, 60));
    return out;
}

TEST(HoldMotion, AStillFormationStaysWhereItIs) {
    const Points points_m = cloud(1, 20);
    EXPECT_EQ(after_hold(points_m, HoldMotion{}), points_m);
}

TEST(HoldMotion, AQuarterTurnIsCounterClockwiseFromAbove) {
    const Points after = after_hold({{10, 0, 5}, {-10, 0, 5}}, {kTurn / 4, {1, 2, 3}});
    EXPECT_LT(glm::distance(after[0], Vec3(1, 12, 8)), 1e-12);
    EXPECT_LT(glm::distance(after[1], Vec3(1, -8, 8)), 1e-12);
}

TEST(HoldMotion, ThoseWhoWaitAbovePadsNeitherMoveNorCount) {
    const Points from_m{{10, 0, 50}, {-10, 0, 50}, {100, 200, 3}};
    const HoldMotion motion{kTurn / 2, {}};
    const Points after = after_hold(from_m, motion, {false, false, true});
    EXPECT_LT(glm::distance(after[0], Vec3(-10, 0, 50)), 1e-12);
    EXPECT_EQ(after[2], from_m[2]);
    const Lattice lattice = hold_lattice(from_m, motion, {false, false, true});
    for (std::size_t k = 0; k < lattice.rows(); ++k) EXPECT_LT(glm::distance(lattice.at(k, 2), from_m[2]), 1e-9);
}

TEST(HoldMotion, EndsAreExactAndAtRest) {
    for (const double spin : {0.3, -2.0, kTurn, 3.0 * kTurn}) {
        const Points from_m = cloud(2, 30);
        const HoldMotion motion{spin, {4, -1, 2}};
        const Lattice lattice = hold_lattice(from_m, motion);
        const Points to_m = after_hold(from_m, motion);
        for (std::size_t i = 0; i < from_m.size(); ++i) {
            for (std::size_t k = 0; k < 3; ++k) {
                EXPECT_EQ(lattice.at(k, i), from_m[i]);
                EXPECT_EQ(lattice.at(lattice.rows() - 1 - k, i), to_m[i]);
            }
        }
    }
}

/// Distances between drones and to the (drifting) axis stay as they are at every instant, not only at knots.
TEST(HoldMotion, TheFormationTurnsAsABody) {
    const Points from_m = cloud(3, 25);
    const HoldMotion motion{1.75 * kTurn, {10, 0, -5}};
    const Act act{"", ActRole::hold, Timing::fixed, 0, 60000, hold_lattice(from_m, motion)};
    Points now(from_m.size());
    for (int ms = 0; ms <= 60000; ms += 37) {
        positions(act, ms / 1000.0, now);
        for (std::size_t i = 1; i < now.size(); ++i) {
            EXPECT_NEAR(glm::distance(now[i], now[i - 1]), glm::distance(from_m[i], from_m[i - 1]), 2e-3);
            EXPECT_NEAR(now[i].z - now[0].z, from_m[i].z - from_m[0].z, 1e-9);
        }
    }
}

TEST(HoldMotion, ScalesAboutTheBarycentreAndMultipliesDistances) {
    const Points from_m = cloud(4, 25);
    HoldMotion motion;
    motion.scale = 1.6;
    motion.spin_rad = 0.7;
    const Points after = after_hold(from_m, motion);
    Vec3 before_sum{}, after_sum{};
    for (std::size_t i = 0; i < from_m.size(); ++i) {
        before_sum += from_m[i];
        after_sum += after[i];
        EXPECT_NEAR(glm::distance(after[i], after[0]), 1.6 * glm::distance(from_m[i], from_m[0]), 1e-9);
    }
    EXPECT_LT(glm::distance(before_sum, after_sum), 1e-8);
}

/// In the middle of the hold, where the wave is whole, every drone is where a sine that has run half its cycles says;
/// before and after it swells and ebbs, and it ends flat.
TEST(HoldMotion, AWaveRunsAlongItsDirectionAndEndsFlat) {
    const Points from_m = cloud(5, 25);
    HoldMotion motion;
    motion.wave = Wave{{0, 3, 1}, {2, 0, 0}, 12.0, 3.0};
    EXPECT_TRUE(motion.moves());
    EXPECT_FALSE(motion.displaces());
    EXPECT_EQ(after_hold(from_m, motion), from_m);
    const Act act{"", ActRole::hold, Timing::fixed, 0, 40000, hold_lattice(from_m, motion)};
    Points now(from_m.size());
    positions(act, 20.0, now);
    double largest_m = 0.0;
    for (std::size_t i = 0; i < now.size(); ++i) {
        const double phase = kTurn * (1.5 - from_m[i].x / 12.0);
        EXPECT_LT(glm::distance(now[i], from_m[i] + std::sin(phase) * Vec3(0, 3, 1)), 2e-3);
    }
    for (int ms = 0; ms <= 40000; ms += 50) {
        positions(act, ms / 1000.0, now);
        for (std::size_t i = 0; i < now.size(); ++i) {
            const Vec3 off_m = now[i] - from_m[i];
            EXPECT_NEAR(off_m.x, 0.0, 1e-9);
            EXPECT_NEAR(off_m.y, 3.0 * off_m.z, 1e-9) << "to and fro along the amplitude";
            largest_m = std::max(largest_m, glm::length(off_m));
        }
    }
    EXPECT_NEAR(largest_m, std::sqrt(10.0), 2e-3);
}

}  // namespace
}  // namespace aerogram::planner
