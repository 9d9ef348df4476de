#include "planner/motion/timing.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "geo/random.hpp"
#include "planner/motion/profile.hpp"

namespace aerogram::planner {
namespace {

Straight one_way(const Vec3& from, const Vec3& to, ProfileKind kind = ProfileKind::minimum_jerk) {
    return {{from}, {to}, profile_rows(kind, 63)};
}

TEST(ShortestDuration, OfALongFlightIsSetByItsSpeed) {
    const Limits limits;
    const auto shortest = shortest_duration(one_way({0, 0, 10}, {100, 0, 10}), limits);
    EXPECT_EQ(shortest.set_by, "speed_horizontal_mps");
    EXPECT_NEAR(static_cast<double>(shortest.duration_ms) / 1000.0, 37.5,
                0.001 * 37.5);  // minimum jerk peaks at 15/8
}

TEST(ShortestDuration, OfAMiddlingFlightIsSetByItsAcceleration) {
    Limits limits;
    limits.speed_horizontal_mps = 50.0;
    limits.jerk_mps3 = 1000.0;
    const auto shortest = shortest_duration(one_way({0, 0, 10}, {20, 0, 10}), limits);
    EXPECT_EQ(shortest.set_by, "acceleration_mps2");
    const double ideal_s = std::sqrt(10.0 / std::sqrt(3.0) * 20.0 / 2.0);  // minimum jerk: peak 10/sqrt(3) L / T²
    EXPECT_NEAR(static_cast<double>(shortest.duration_ms) / 1000.0, ideal_s, 0.01 * ideal_s);
}

TEST(ShortestDuration, ClimbAndDescentHaveTheirOwnLimits) {
    const Limits limits;
    const auto up = shortest_duration(one_way({0, 0, 10}, {0, 0, 60}), limits);
    const auto down = shortest_duration(one_way({0, 0, 60}, {0, 0, 10}), limits);
    EXPECT_EQ(up.set_by, "speed_up_mps");
    EXPECT_EQ(down.set_by, "speed_down_mps");
    EXPECT_NEAR(static_cast<double>(down.duration_ms) / static_cast<double>(up.duration_ms), 2.5 / 2.0, 1e-3);
}

TEST(ShortestDuration, IsZeroWhereNobodyMoves) {
    EXPECT_EQ(shortest_duration(one_way({1, 2, 3}, {1, 2, 3}), Limits{}).duration_ms, 0);
    EXPECT_EQ(shortest_duration(Hold{{{1, 2, 3}}}, Limits{}).duration_ms, 0);
}

/// At the shortest duration every limit holds, and a millisecond less breaks the one that is named.
TEST(ShortestDuration, IsTightOnRandomLattices) {
    Random random(42);
    for (int round = 0; round < 50; ++round) {
        constexpr std::size_t rows = 25, n = 3;
        Points samples((rows - 2) * n);
        for (Vec3& p : samples) p = {random.between(-3, 3), random.between(-3, 3), random.between(5, 9)};
        const Lattice lattice = lattice_through(samples, n);
        Limits limits;
        limits.acceleration_mps2 = random.between(0.5, 4.0);
        limits.jerk_mps3 = random.between(2.0, 2000.0);
        const auto shortest = shortest_duration(lattice, limits);
        const auto ratio = [&](Millis duration_ms) {
            const Extremes e = extremes(lattice, static_cast<double>(duration_ms) / 1000.0);
            return std::max({e.speed_horizontal_mps / limits.speed_horizontal_mps, e.speed_up_mps / limits.speed_up_mps,
                             e.speed_down_mps / limits.speed_down_mps, e.acceleration_mps2 / limits.acceleration_mps2,
                             e.jerk_mps3 / limits.jerk_mps3});
        };
        EXPECT_LE(ratio(shortest.duration_ms), 1.0 + 1e-9);
        EXPECT_GT(ratio(shortest.duration_ms - 1), 1.0);
    }
}

TEST(Extremes, AreAttainedOrJustAboveADenseSampling) {
    constexpr std::size_t rows = 63;
    Points samples(rows - 2);
    for (std::size_t m = 0; m < samples.size(); ++m) {
        const double a = 5 * profile_value(ProfileKind::minimum_jerk, static_cast<double>(m) / (rows - 3));
        samples[m] = {8 * std::cos(a), 8 * std::sin(a), 20 + a};
    }
    const Act act{"x", ActRole::transit, Timing::free, 0, 20000, lattice_through(samples, 1)};
    const Extremes e = extremes(act.motion, 20.0);
    double speed = 0.0, acceleration = 0.0;
    for (int i = 0; i <= 200000; ++i) {
        const Kinematics k = kinematics(act, DroneId{}, i * 1e-4);
        speed = std::max(speed, glm::length(Vec2(k.velocity_mps)));
        acceleration = std::max(acceleration, glm::length(k.acceleration_mps2));
    }
    EXPECT_GE(e.speed_horizontal_mps, speed);
    EXPECT_LT(e.speed_horizontal_mps, 1.01 * speed);
    EXPECT_GE(e.acceleration_mps2, acceleration - 1e-9);
    EXPECT_LT(e.acceleration_mps2, 1.0001 * acceleration);
}

}  // namespace
}  // namespace aerogram::planner
