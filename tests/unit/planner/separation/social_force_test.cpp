#include "planner/separation/social_force.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stop_token>

#include "geo/random.hpp"
#include "planner/motion/certificate.hpp"
#include "planner/motion/profile.hpp"

namespace aerogram::planner {
namespace {

Lattice straight_lattice(const Points& from, const Points& to, std::size_t rows = 63) {
    Lattice lattice{from.size(), {}};
    for (const double share : profile_rows(ProfileKind::minimum_jerk, rows)) {
        for (std::size_t i = 0; i < from.size(); ++i) {
            lattice.points_m.push_back((1.0 - share) * from[i] + share * to[i]);
        }
    }
    return lattice;
}
SocialForceTask task_for(double required_m, double downwash = 1.0) {
    SocialForceTask task;
    task.required_m = required_m;
    task.metric = {downwash};
    return task;
}
Projected eased(const Lattice& reference, const SocialForceTask& task) {
    return std::move(ease_by_social_forces(reference, task, aerogram::Run{})).value();
}
/// Two crowds of n x n that walk through each other, their rows between those of the other or head-on.
Lattice crossing(std::size_t side, double shift_m) {
    Points from, to;
    for (std::size_t a = 0; a < side; ++a) {
        for (std::size_t b = 0; b < side; ++b) {
            const Vec3 p{2.5 * static_cast<double>(a), 2.5 * static_cast<double>(b), 20.0};
            const Vec3 far{40.0, 0.0, 0.0}, shift{0.0, shift_m, 0.0};
            from.push_back(p);
            to.push_back(p + far);
            from.push_back(p + far + shift);
            to.push_back(p + shift);
        }
    }
    return straight_lattice(from, to);
}
/// The smallest distance over a dense sampling, in the metric: not the bound's code.
double sampled_minimum_m(const Lattice& lattice, const SeparationMetric& metric) {
    const Act act{"", ActRole::transit, Timing::free, 0, 1000, lattice};
    double least_m = std::numeric_limits<double>::infinity();
    Points now(lattice.drones);
    for (int step = 0; step <= 400; ++step) {
        positions(act, step / 400.0, now);
        for (std::size_t i = 0; i < now.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) least_m = std::min(least_m, metric.distance(now[i], now[j]));
        }
    }
    return least_m;
}

TEST(SocialForce, Property1_TheEndsRowsAreKept) {
    const Lattice reference = crossing(3, 0.4);
    const Projected result = eased(reference, task_for(1.5));
    ASSERT_EQ(result.lattice.points_m.size(), reference.points_m.size());
    ASSERT_GT(result.rounds, 0);
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t i = 0; i < reference.drones; ++i) {
            EXPECT_EQ(result.lattice.at(k, i), reference.at(k, i));
            const std::size_t last = reference.rows() - 1 - k;
            EXPECT_EQ(result.lattice.at(last, i), reference.at(last, i));
        }
    }
}

TEST(SocialForce, Property2_WhatIsSeparatedComesBackUnchanged) {
    const Lattice reference = crossing(3, 1.25);
    ASSERT_GT(sampled_minimum_m(reference, {}), 1.2);
    const Projected result = eased(reference, task_for(1.2));
    EXPECT_TRUE(result.separated);
    EXPECT_EQ(result.rounds, 0);
    EXPECT_EQ(result.lattice.points_m, reference.points_m);
}

TEST(SocialForce, Property3_SameSeedSameMotion) {
    const Lattice reference = crossing(2, 0.0);
    SocialForceTask task = task_for(1.5);
    const Points first = eased(reference, task).lattice.points_m;
    EXPECT_EQ(first, eased(reference, task).lattice.points_m);
    task.seed = 2;
    EXPECT_NE(first, eased(reference, task).lattice.points_m);
}

TEST(SocialForce, Property4_NeverCloserThanTheReferenceAndTheBoundIsTrue) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        Random random(seed);
        Points from, to;
        for (std::size_t i = 0; i < 25; ++i) {
            from.push_back({3.0 * static_cast<double>(i % 5), 3.0 * static_cast<double>(i / 5), 10.0});
        }
        to = from;
        for (std::size_t i = to.size(); i > 1; --i) std::swap(to[i - 1], to[random.below(i)]);
        for (Vec3& p : to) p += Vec3{0.0, 12.0, 4.0};
        const Lattice reference = straight_lattice(from, to);
        const SeparationMetric metric{seed % 2 == 0 ? 2.0 : 1.0};
        const Projected result = eased(reference, task_for(1.2, metric.downwash));
        EXPECT_GE(result.lower_bound_m + 1e-6, 0.98 * std::min(2.4, sampled_minimum_m(reference, metric)));
        EXPECT_LE(result.lower_bound_m, sampled_minimum_m(result.lattice, metric) + 1e-9) << "seed " << seed;
        EXPECT_EQ(result.separated, result.lower_bound_m >= 1.2 - kSeparationTolerance_m) << "seed " << seed;
    }
}

TEST(SocialForce, TwoWhoMeetHeadOnStepAside) {
    const Lattice reference = straight_lattice({{0, 0, 10}, {30, 0, 10}}, {{30, 0, 10}, {0, 0, 10}});
    ASSERT_LT(sampled_minimum_m(reference, {}), 0.1);
    const Projected result = eased(reference, task_for(1.5));
    EXPECT_TRUE(result.separated);
    EXPECT_GE(sampled_minimum_m(result.lattice, {}), 1.5 - 1e-4);
}

TEST(SocialForce, CrowdsPassThroughEachOther) {
    const Lattice reference = crossing(4, 0.3);
    ASSERT_LT(sampled_minimum_m(reference, {}), 0.4);
    EXPECT_GE(sampled_minimum_m(eased(reference, task_for(1.2)).lattice, {}), 0.9);
}

TEST(SocialForce, FreeRowsStayInTheBand) {
    const Lattice reference = crossing(3, 0.0);
    SocialForceTask task = task_for(1.5);
    task.floor_z_m = 19.8;
    task.ceiling_z_m = 20.3;
    for (const Vec3& p : eased(reference, task).lattice.points_m) {
        EXPECT_GE(p.z, 19.8);
        EXPECT_LE(p.z, 20.3);
    }
}

TEST(SocialForce, AStopIsHeard) {
    std::stop_source stop;
    stop.request_stop();
    aerogram::Run run;
    run.stop = stop.get_token();
    const auto result = ease_by_social_forces(crossing(2, 0.0), task_for(1.5), run);
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().code, ErrorCode::stopped);
}

}  // namespace
}  // namespace aerogram::planner
