#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "planner/motion/act.hpp"
#include "planner/motion/profile.hpp"
#include "tests/unit/planner/assignment/instances.hpp"

/// Acts for the benchmarks of motion and separation.
namespace aerogram::bench {

inline constexpr std::size_t kRows = 63;

/// n drones from a sheet (40 m up) to a sphere, everyone to the slot that costs the least together.
inline planner::Straight sheet_to_ball(std::size_t n) {
    using namespace planner;
    Points from = testing::sheet(n), to = testing::ball(n), by_drone(n);
    for (Vec3& p : from) p.z += 40.0;
    for (Vec3& p : to) p += Vec3{10, 15, 60};
    const auto slot_of = assign_shortest(from, to, {}, {}, Run{}).value().slot_of;
    for (std::size_t d = 0; d < n; ++d) by_drone[d] = to[slot_of[d].value];
    return {from, by_drone, profile_rows(ProfileKind::minimum_jerk, kRows)};
}

/// The same motion with all its control points.
inline planner::Lattice lattice_of(const planner::Straight& straight) {
    planner::Lattice lattice{straight.from_m.size(), {}};
    const planner::Motion motion = straight;
    for (std::size_t k = 0; k < straight.profile.size(); ++k) {
        for (std::size_t i = 0; i < lattice.drones; ++i)
            lattice.points_m.push_back(planner::control_point(motion, k, i));
    }
    return lattice;
}

/// The oracle: all pairs at `samples` instants of an act of one second.
inline double sampled_separation(const planner::Motion& motion, const SeparationMetric& metric, int samples = 400) {
    const planner::Act act{"", planner::ActRole::transit, planner::Timing::free, 0, 1000, motion};
    double least = std::numeric_limits<double>::infinity();
    Points now(planner::drone_count(motion));
    for (int s = 0; s <= samples; ++s) {
        planner::positions(act, static_cast<double>(s) / samples, now);
        for (std::size_t i = 0; i < now.size(); ++i) {
            for (std::size_t j = i + 1; j < now.size(); ++j) least = std::min(least, metric.distance(now[i], now[j]));
        }
    }
    return least;
}

}  // namespace aerogram::bench
