#include "planner/motion/plane_rules.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "geo/random.hpp"
#include "geo/units.hpp"

namespace aerogram::planner {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Act flown(Motion motion, Millis duration_ms) {
    return {"a", ActRole::transit, Timing::fixed, 0, duration_ms, std::move(motion)};
}

Lattice random_flight(Random& random, std::size_t drones, std::size_t rows) {
    Lattice lattice{drones, {}};
    for (std::size_t k = 0; k < rows; ++k) {
        for (std::size_t i = 0; i < drones; ++i) {
            lattice.points_m.emplace_back(18.0 * static_cast<double>(k) + random.between(-3, 3), random.between(-4, 4),
                                          random.between(-2, 2));
        }
    }
    return lattice;
}

TEST(PlaneRules, Property1And2_BoundsEncloseADenseSamplingClosely) {
    constexpr std::uint64_t kSeed = 7;
    SCOPED_TRACE(kSeed);
    Random random(kSeed);
    for (int round = 0; round < 20; ++round) {
        const Act act = flown(random_flight(random, 3, 9), 6000);
        const PlaneExtremes found = plane_extremes(act.motion, 6.0);
        double slowest = 1e9, fastest = 0, turn = 0, climb = -1e9, sink = -1e9;
        for (std::size_t i = 0; i < 3; ++i) {
            for (int step = 0; step <= 12000; ++step) {
                const Kinematics k = kinematics(act, DroneId(i), 6.0 * step / 12000);
                const Vec3 v = k.velocity_mps, a = k.acceleration_mps2;
                slowest = std::min(slowest, glm::length(v));
                fastest = std::max(fastest, glm::length(v));
                turn = std::max(turn, degrees(std::abs(v.x * a.y - v.y * a.x) / (v.x * v.x + v.y * v.y)));
                climb = std::max(climb, v.z);
                sink = std::max(sink, -v.z);
            }
        }
        const auto brackets = [](double bound, double sampled, double sign) {
            EXPECT_GE(sign * (bound - sampled), -1e-12);
            EXPECT_LE(sign * (bound - sampled), 1e-4 * std::max(1.0, sampled));
        };
        brackets(found.airspeed_min_mps.value, slowest, -1.0);
        brackets(found.airspeed_max_mps.value, fastest, 1.0);
        brackets(found.turn_rate_dps.value, turn, 1.0);
        brackets(found.climb_mps.value, climb, 1.0);
        brackets(found.sink_mps.value, sink, 1.0);
        const Kinematics at = kinematics(act, DroneId(found.airspeed_min_mps.drone), found.airspeed_min_mps.time_s);
        EXPECT_NEAR(glm::length(at.velocity_mps), found.airspeed_min_mps.value, 1e-3);
    }
}

TEST(PlaneRules, Property3_ASteadyCircleTurnsAtSpeedOverRadius) {
    constexpr double kRadius_m = 100.0, kRate = 0.2;  // rad/s
    Lattice circle{1, {}};
    const double h = 0.05;
    // Control points on a circle a little larger than the curve's give the curve its radius at the knots.
    const double larger = 3.0 / (2.0 + std::cos(kRate * h));
    for (int k = 0; k < 60; ++k)
        circle.points_m.emplace_back(kRadius_m * larger * std::cos(kRate * h * k),
                                     kRadius_m * larger * std::sin(kRate * h * k), 50.0);
    const PlaneExtremes found = plane_extremes(circle, 57 * h);
    EXPECT_NEAR(found.turn_rate_dps.value, degrees(kRate), 1e-2);
    EXPECT_NEAR(found.airspeed_max_mps.value, kRadius_m * kRate, 1e-3);
    EXPECT_NEAR(found.airspeed_min_mps.value, kRadius_m * kRate, 1e-3);
    EXPECT_NEAR(found.climb_mps.value, 0.0, 1e-9);
}

TEST(PlaneRules, AHoverHasNoAirspeedAndNoTurnRate) {
    const PlaneExtremes found = plane_extremes(Hold{{Vec3{1, 2, 3}, Vec3{20, 2, 3}}}, 5.0);
    EXPECT_EQ(found.airspeed_min_mps.value, 0.0);
    EXPECT_TRUE(std::isinf(found.turn_rate_dps.value));
    EXPECT_EQ(found.climb_mps.value, 0.0);
}

TEST(PlaneRules, ViolationsNameLimitDroneValueAndShowTime) {
    Lattice climbs{2, {}};
    for (int k = 0; k < 8; ++k) {
        climbs.points_m.emplace_back(18.0 * k, 0.0, 50.0);
        climbs.points_m.emplace_back(18.0 * k, 30.0, 50.0 + 5.0 * k);
    }
    const PlaneExtremes found = plane_extremes(climbs, 5.0);
    EXPECT_THAT(plane_violations(found, PlaneLimits{}, 12000),
                ElementsAre(HasSubstr("climb_mps: drone 2 reaches 5 at 12.00 s, limit 4")));
    EXPECT_TRUE(plane_violations(found, {12, 28, 30, 5, 5}, 12000).empty());
}

}  // namespace
}  // namespace aerogram::planner
