#include "planner/motion/act.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "geo/random.hpp"
#include "planner/motion/flight_plan.hpp"
#include "planner/motion/profile.hpp"

namespace aerogram::planner {
namespace {

Lattice random_lattice(std::size_t drones, std::size_t rows, std::uint64_t seed) {
    Random random(seed);
    Lattice lattice{drones, Points(drones * rows)};
    for (Vec3& p : lattice.points_m) p = {random.between(-9, 9), random.between(-9, 9), random.between(5, 20)};
    for (std::size_t i = 0; i < drones; ++i) {
        for (std::size_t k = 1; k < 3; ++k) {
            lattice.at(k, i) = lattice.at(0, i);
            lattice.at(rows - 1 - k, i) = lattice.at(rows - 1, i);
        }
    }
    return lattice;
}

/// The B-spline by de Boor's recursion on the infinite uniform knot sequence, written out independently of the product.
Vec3 de_boor(const Lattice& lattice, std::size_t drone, double u) {
    const auto interval = std::min(static_cast<std::size_t>(u), lattice.rows() - 4);
    std::array<Vec3, 4> d{};
    for (std::size_t j = 0; j < 4; ++j) d[j] = lattice.at(interval + j, drone);
    for (int r = 1; r <= 3; ++r) {
        for (int j = 3; j >= r; --j) {
            const double knot = static_cast<double>(interval) + j - 3;  // left knot of the blending interval
            const double alpha = (u - knot) / static_cast<double>(4 - r);
            d[static_cast<std::size_t>(j)] =
                (1.0 - alpha) * d[static_cast<std::size_t>(j - 1)] + alpha * d[static_cast<std::size_t>(j)];
        }
    }
    return d[3];
}

TEST(Lattice, PositionsAgreeWithDeBoor) {
    const Lattice lattice = random_lattice(3, 15, 7);
    const Act act{"x", ActRole::transit, Timing::free, 0, 6000, lattice};
    for (double t_s = 0.0; t_s <= 6.0; t_s += 0.037) {
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3 p = kinematics(act, DroneId(i), t_s).position_m;
            EXPECT_LT(glm::length(p - de_boor(lattice, i, t_s / 0.5)), 1e-12) << t_s;
        }
    }
}

TEST(Lattice, VelocityAndAccelerationAreTheDerivatives) {
    const Act act{"x", ActRole::transit, Timing::free, 0, 6000, random_lattice(2, 15, 11)};
    constexpr double e = 1e-5;
    for (double t_s = 0.1; t_s < 5.9; t_s += 0.0771) {
        const Kinematics k = kinematics(act, DroneId{1}, t_s);
        const Vec3 before = kinematics(act, DroneId{1}, t_s - e).position_m,
                   after = kinematics(act, DroneId{1}, t_s + e).position_m;
        EXPECT_LT(glm::length((after - before) / (2 * e) - k.velocity_mps), 1e-5);
        const Vec3 v0 = kinematics(act, DroneId{1}, t_s - e).velocity_mps,
                   v1 = kinematics(act, DroneId{1}, t_s + e).velocity_mps;
        EXPECT_LT(glm::length((v1 - v0) / (2 * e) - k.acceleration_mps2), 2e-3);
    }
}

TEST(Lattice, BezierPiecesAreTheSameCurve) {
    const Lattice lattice = random_lattice(2, 12, 3);
    const Motion motion = lattice;
    for (std::size_t m = 0; m < interval_count(motion); ++m) {
        const auto b = bezier(motion, m, 1);
        for (double u = 0.0; u <= 1.0; u += 0.125) {
            const double v = 1.0 - u;
            const Vec3 p = v * v * v * b[0] + 3 * v * v * u * b[1] + 3 * v * u * u * b[2] + u * u * u * b[3];
            EXPECT_LT(glm::length(p - de_boor(lattice, 1, static_cast<double>(m) + u)), 1e-12);
        }
    }
}

TEST(Lattice, RestsAtItsEnds) {
    const Act act{"x", ActRole::transit, Timing::free, 0, 6000, random_lattice(1, 15, 5)};
    for (const double t_s : {0.0, 6.0}) {
        const Kinematics k = kinematics(act, DroneId{}, t_s);
        EXPECT_LT(glm::length(k.velocity_mps), 1e-12);
        EXPECT_LT(glm::length(k.acceleration_mps2), 1e-12);
    }
}

TEST(LatticeThrough, MeetsItsSamplesAtTheKnots) {
    constexpr std::size_t n = 4, knots = 41;
    Points samples(n * knots);
    for (std::size_t m = 0; m < knots; ++m) {
        const double s = profile_value(ProfileKind::minimum_jerk, static_cast<double>(m) / (knots - 1));
        for (std::size_t i = 0; i < n; ++i)
            samples[m * n + i] = {std::cos(3 * s + static_cast<double>(i)), std::sin(3 * s), 5.0 * s};
    }
    const Lattice lattice = lattice_through(samples, n);
    ASSERT_EQ(lattice.rows(), knots + 2);
    for (std::size_t m = 0; m < knots; ++m) {
        if (m == 1 || m + 2 == knots) continue;  // free: rest at the ends takes their condition
        for (std::size_t i = 0; i < n; ++i) {
            const Vec3 at_knot = knot_value(lattice.at(m, i), lattice.at(m + 1, i), lattice.at(m + 2, i));
            EXPECT_LT(glm::length(at_knot - samples[m * n + i]), 1e-12) << m;
        }
    }
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(lattice.at(k, 2), samples[2]);
        EXPECT_EQ(lattice.at(lattice.rows() - 1 - k, 2), samples[(knots - 1) * n + 2]);
    }
}

TEST(Straight, IsTheLatticeOfItsControlPoints) {
    const Straight straight{{{0, 0, 5}, {3, 1, 6}}, {{9, 2, 15}, {-3, 4, 8}}, profile_rows(ProfileKind::s_curve, 23)};
    Lattice lattice{2, {}};
    for (std::size_t k = 0; k < 23; ++k) {
        for (std::size_t i = 0; i < 2; ++i) lattice.points_m.push_back(control_point(straight, k, i));
    }
    const Act a{"x", ActRole::transit, Timing::free, 0, 5000, straight},
        b{"x", ActRole::transit, Timing::free, 0, 5000, lattice};
    for (double t_s = 0.0; t_s <= 5.0; t_s += 0.113) {
        const Kinematics p = kinematics(a, DroneId{1}, t_s), q = kinematics(b, DroneId{1}, t_s);
        EXPECT_LT(glm::length(p.position_m - q.position_m), 1e-12);
        EXPECT_LT(glm::length(p.velocity_mps - q.velocity_mps), 1e-12);
        EXPECT_LT(glm::length(p.acceleration_mps2 - q.acceleration_mps2), 1e-11);
        Points all(2);
        positions(a, t_s, all);
        EXPECT_LT(glm::length(all[1] - p.position_m), 1e-12);
    }
    EXPECT_EQ(start_positions(Motion(straight)), straight.from_m);
    EXPECT_EQ(end_positions(Motion(straight)), straight.to_m);
}

/// Part of a ride: rows that do not repeat.
TEST(Lattice, InMotionAtItsEndsBeginsAndEndsOnItsCurve) {
    Random random(4);
    Lattice lattice{3, Points(3 * 11)};
    for (Vec3& p : lattice.points_m) p = {random.between(-9, 9), random.between(-9, 9), random.between(5, 9)};
    const Vec3 rest{0.1, 0.2, 0.3};
    for (const std::size_t k : {0U, 1U, 2U, 8U, 9U, 10U}) lattice.at(k, 2) = rest;
    const Act act{"x", ActRole::transit, Timing::fixed, 0, 4000, lattice};
    const Points begin = start_positions(act.motion), end = end_positions(act.motion);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_LT(glm::length(begin[i] - kinematics(act, DroneId(i), 0.0).position_m), 1e-13);
        EXPECT_LT(glm::length(end[i] - kinematics(act, DroneId(i), 4.0).position_m), 1e-13);
    }
    EXPECT_GT(glm::length(begin[0] - lattice.at(0, 0)), 0.1);
    EXPECT_EQ(begin[2], rest);  // to the last bit where it stands
    EXPECT_EQ(end[2], rest);
}

TEST(Profile, TimeShareIsTheInverseOfTheProfile) {
    for (const ProfileKind kind : {ProfileKind::minimum_jerk, ProfileKind::trapezoid, ProfileKind::s_curve}) {
        const auto rows = profile_rows(kind, 33);
        const Act act{"x", ActRole::transit, Timing::free, 0, 1000, Straight{{Vec3{}}, {Vec3{1, 0, 0}}, rows}};
        EXPECT_EQ(time_share_at(rows, 0.0), 0.0);
        for (double s = 0.01; s < 1.0; s += 0.01) {
            EXPECT_NEAR(kinematics(act, DroneId{}, time_share_at(rows, s)).position_m.x, s, 1e-12);
        }
    }
}

TEST(Profile, IsMonotoneFromRestToRest) {
    for (const ProfileKind kind : {ProfileKind::minimum_jerk, ProfileKind::trapezoid, ProfileKind::s_curve}) {
        double before = 0.0;
        for (int i = 1; i <= 1000; ++i) {
            const double s = profile_value(kind, i / 1000.0);
            EXPECT_GE(s, before);
            EXPECT_LT(s - before, 0.0025);  // no jump: speed at most 2.5 of the mean
            before = s;
        }
        EXPECT_EQ(profile_value(kind, 0.0), 0.0);
        EXPECT_EQ(profile_value(kind, 1.0), 1.0);
        EXPECT_NEAR(profile_value(kind, 0.5), 0.5, 1e-12);
        EXPECT_LT(profile_value(kind, 1e-4), 1e-6);
        const auto rows = profile_rows(kind, 43);
        EXPECT_TRUE(std::is_sorted(rows.begin(), rows.end()));
        EXPECT_EQ(rows[2], 0.0);
        EXPECT_EQ(rows[40], 1.0);
    }
}

FlightPlan two_act_plan() {
    FlightPlan plan;
    plan.pads_m = {{0, 0, 0}, {5, 0, 0}};
    plan.acts.push_back({"up", ActRole::takeoff, Timing::free, 0, 4000,
                         Straight{plan.pads_m, {{0, 0, 3}, {5, 0, 3}}, profile_rows(ProfileKind::minimum_jerk, 23)}});
    plan.acts.push_back({"stay", ActRole::hold, Timing::free, 4000, 2000, Hold{{{0, 0, 3}, {5, 0, 3}}}});
    plan.tracks.resize(2);
    plan.tracks[1].lights = {{0, {}, true}, {4000, {1, 0, 0}, false}};
    plan.tracks[1].yaw = {{0, 0.0}, {4000, 1.0}};
    return plan;
}

TEST(Sample, FindsTheActAndEvaluatesTracks) {
    const FlightPlan plan = two_act_plan();
    EXPECT_EQ(act_at(plan, -1.0), 0u);
    EXPECT_EQ(act_at(plan, 3.999), 0u);
    EXPECT_EQ(act_at(plan, 4.0), 1u);
    EXPECT_EQ(act_at(plan, 99.0), 1u);
    const DroneState state = sample(plan, DroneId{1}, 2.0);
    EXPECT_NEAR(state.motion.position_m.z, 1.5, 1e-12);
    EXPECT_NEAR(state.color.r, 0.5, 1e-12);
    EXPECT_NEAR(state.yaw_rad, 0.5, 1e-12);
    std::vector<DroneState> fleet(2);
    sample(plan, 2.0, fleet);
    EXPECT_EQ(fleet[1].motion.position_m, state.motion.position_m);
    EXPECT_EQ(fleet[1].color, state.color);
}

}  // namespace
}  // namespace aerogram::planner
