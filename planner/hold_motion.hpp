#pragma once
#include <vector>

#include "planner/mission/mission.hpp"
#include "planner/motion/act.hpp"

namespace aerogram::planner {

/// Where a formation is after its hold: turned by the spin about the vertical through its barycentre and scaled about
/// it, moved by the drift. Waves end flat. Distances between those who move are multiplied by the scale.
/// @param still  one a place, or empty: places marked neither move nor count for the barycentre (spares above pads).
[[nodiscard]] Points after_hold(const Points& formation_m, const HoldMotion& motion,
                                const std::vector<bool>& still = {});

/// The hold as one act at rest at both ends: spin, drift and scale by one minimum-jerk clock; a wave runs at an even
/// pace, swells over the first quarter of the time and ebbs over the last. Ends are formation_m and after_hold's,
/// exactly. Accuracy: within 1e-5 of a drone's distance from the axis of the true circle between knots.
[[nodiscard]] Lattice hold_lattice(const Points& formation_m, const HoldMotion& motion,
                                   const std::vector<bool>& still = {});

}  // namespace aerogram::planner
