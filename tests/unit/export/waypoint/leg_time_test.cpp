#include "export/waypoint/leg_time.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geo/random.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

/// Flies a gain of speed by adding up small steps of a jerk that rises and falls like a raised cosine.
struct Flown {
    double length_m = 0.0, speed_mps = 0.0, acceleration_mps2 = 0.0, most_mps2 = 0.0, time_s = 0.0;

    void pulse(double jerk, double rise_s, double stays_s) {
        const double length_s = 2.0 * rise_s + stays_s;
        constexpr int kSteps = 4000;
        const double dt = length_s / kSteps;
        for (int k = 0; k < kSteps; ++k) {
            const double t = (k + 0.5) * dt, to_edge_s = std::min({t, length_s - t, rise_s});
            const double share = rise_s > 0.0 ? 0.5 - 0.5 * std::cos(kPi * to_edge_s / rise_s) : 1.0;
            step(dt, jerk * share);
        }
    }
    void step(double dt, double jerk) {
        const double before = acceleration_mps2;
        acceleration_mps2 += jerk * dt;
        const double middle = 0.5 * (before + acceleration_mps2);
        length_m += speed_mps * dt + 0.5 * middle * dt * dt;
        speed_mps += middle * dt;
        time_s += dt;
        most_mps2 = std::max(most_mps2, acceleration_mps2);
    }
    void coast(double dt) {
        if (dt > 0.0) step(dt, 0.0);
    }
};

/// The best of all rest-to-rest S-curves on a grid of peaks, for legs too short to reach the speed limit as well.
double brute_force_s(const LegModel& m, double speed_mps, double length_m) {
    const double sharpness = 0.5 * m.jerk_mps3 * kPi / kJerkRise_s;
    double best_s = 1e300;
    for (int k = 1; k <= 4000; ++k) {
        const double peak = m.acceleration_mps2 * k / 4000.0;
        const double rise_s = std::min(kJerkRise_s, std::sqrt(0.5 * kPi * peak / sharpness));
        const double jerk = 2.0 * sharpness * rise_s / kPi;
        const double bend_s = peak / jerk + rise_s;
        // With ramps of this peak: as fast as the length and the limit allow, but no slower than the bends alone.
        const double by_length = 0.5 * peak * (std::sqrt(bend_s * bend_s + 4.0 * length_m / peak) - bend_s);
        const double v = std::min(speed_mps, by_length);
        if (v < peak * bend_s * (1.0 - 1e-12)) continue;
        best_s = std::min(best_s, length_m / v + v / peak + bend_s);
    }
    return best_s;
}

TEST(LegTime, WithoutEdgesIsTheTrapezoid) {
    const LegModel quick{5.0, 2.5, 2.0, 1.0, 1e9};
    EXPECT_NEAR(s_curve_s(quick, 5.0, 100.0), 100.0 / 5.0 + 5.0 / 1.0, 1e-3);
    EXPECT_NEAR(s_curve_s({5.0, 2.5, 2.0, 1.0, 1.0}, 5.0, 100.0), 20.0 + 5.0 + 1.0 + kJerkRise_s, 1e-9);
    EXPECT_EQ(s_curve_s(quick, 5.0, 0.0), 0.0);
}

/// ArduPilot's own closed forms for the shortest legs and speeds (SCurve::calculate_path).
TEST(LegTime, OfShortLegsIsEightRises) {
    const LegModel m{5.0, 2.5, 2.0, 1.0, 1.0};
    const double sharpness = 0.5 * kPi / kJerkRise_s, length_m = 0.05;
    EXPECT_NEAR(s_curve_s(m, 5.0, length_m), 8.0 * std::pow(kPi * 0.5 * length_m / (8.0 * sharpness), 0.25), 1e-9);
}

TEST(LegTime, Property1_TheProfileCoversTheLengthWithinItsLimits) {
    Flown ramp;  // peak 1.2, jerk 0.9, rises 0.4, speed 5
    const double stays_s = 1.2 / 0.9 - kJerkRise_s;
    ramp.pulse(0.9, kJerkRise_s, stays_s);
    ramp.coast(5.0 / 1.2 - 1.2 / 0.9 - kJerkRise_s);
    ramp.pulse(-0.9, kJerkRise_s, stays_s);
    EXPECT_NEAR(ramp.speed_mps, 5.0, 1e-6);
    EXPECT_NEAR(ramp.most_mps2, 1.2, 1e-6);
    EXPECT_NEAR(2.0 * ramp.time_s, s_curve_s({5.0, 2.5, 2.0, 1.2, 0.9}, 5.0, 2.0 * ramp.length_m), 1e-5);
}

TEST(LegTime, IsTheBestOfAllPeaks) {
    Random random(20261122);
    for (int k = 0; k < 300; ++k) {
        const LegModel m{0, 0, 0, random.between(0.1, 4.0), random.between(0.2, 8.0)};
        const double speed = random.between(0.1, 12.0), length = std::exp(random.between(-4.0, 6.0));
        const double exact = s_curve_s(m, speed, length), best = brute_force_s(m, speed, length);
        EXPECT_LE(exact, best + 1e-9) << m.acceleration_mps2 << ' ' << m.jerk_mps3 << ' ' << speed << ' ' << length;
        EXPECT_NEAR(exact, best, 2e-3 * best)
            << m.acceleration_mps2 << ' ' << m.jerk_mps3 << ' ' << speed << ' ' << length;
    }
}

TEST(LegTime, Property2_LongerAndSlowerLegsTakeLonger) {
    Random random(7);
    for (int k = 0; k < 1000; ++k) {
        const LegModel m{0, 0, 0, random.between(0.1, 4.0), random.between(0.2, 8.0)};
        const double speed = random.between(0.1, 12.0), length = std::exp(random.between(-6.0, 6.0));
        const double t = s_curve_s(m, speed, length);
        EXPECT_GE(t, length / speed);
        EXPECT_GE(s_curve_s(m, speed, 1.01 * length), t);
        EXPECT_GE(s_curve_s(m, 0.99 * speed, length), t - 1e-9);
        LegModel softer = m;
        softer.jerk_mps3 *= 0.9;
        EXPECT_GE(s_curve_s(softer, speed, length), t - 1e-9);
    }
}

TEST(LegTime, SpeedAlongALegHoldsEveryClass) {
    const LegModel m{5.0, 2.5, 2.0, 1.0, 1.0};
    EXPECT_EQ(leg_speed_mps(m, {3.0, 4.0, 0.0}), 5.0);
    EXPECT_EQ(leg_speed_mps(m, {0.0, 0.0, 9.0}), 2.5);
    EXPECT_EQ(leg_speed_mps(m, {0.0, 0.0, -9.0}), 2.0);
    EXPECT_NEAR(leg_speed_mps(m, {3.0, 0.0, 4.0}), 2.5 / 0.8, 1e-12);
    EXPECT_NEAR(leg_speed_mps(m, {3.0, 0.0, -4.0}), 2.0 / 0.8, 1e-12);
    EXPECT_NEAR(leg_speed_mps(m, {4.0, 0.0, 0.4}), 5.0 * std::hypot(4.0, 0.4) / 4.0, 1e-12);
}

TEST(LegTime, ModelTakesTheLimitsWhereTheMissionSaysNothing) {
    const Limits limits;
    planner::ExportWishes wishes;
    EXPECT_EQ(leg_model(wishes, limits).speed_down_mps, limits.speed_down_mps);
    wishes.leg_speed_down_mps = 1.5;
    wishes.leg_jerk_mps3 = 3.0;
    EXPECT_EQ(leg_model(wishes, limits).speed_down_mps, 1.5);
    EXPECT_EQ(leg_model(wishes, limits).jerk_mps3, 3.0);
}

TEST(LegTime, HoldsAndStepsAreInWhatALegNeeds) {
    const LegModel m{5.0, 2.5, 2.0, 1.0, 1.0};
    EXPECT_EQ(leg_needs_s(m, {}), 1.5);
    EXPECT_NEAR(leg_needs_s(m, {100.0, 0.0, 0.0}), 20.0 + 6.4 + 1.5, 1e-9);
    EXPECT_NEAR(takeoff_needs_s(m, 25.0), 3.0 + 25.0 / 2.5 + 2.5 + 1.4 + 0.5, 1e-9);
}

TEST(LegTime, SpeedForATimeTakesThatTime) {
    const LegModel m{5.0, 2.5, 2.0, 1.0, 1.0};
    const Vec3 way{20.0, 10.0, 5.0};
    const double speed = speed_for_s(m, way, 25.0);
    EXPECT_LT(speed, 5.0);
    EXPECT_NEAR(s_curve_s(m, speed, glm::length(way)), 25.0, 1e-6);
    EXPECT_EQ(speed_for_s(m, way, 1.0), leg_speed_mps(m, way));
}

}  // namespace
}  // namespace aerogram::exporter
