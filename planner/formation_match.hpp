#pragma once
#include <span>
#include <vector>

#include "planner/assignment/assignment.hpp"
#include "planner/formation/formation.hpp"

namespace aerogram::planner {

/// Who flies where by formation coordinates (paper 002, section 3.4), between any two formations: slots on the rim of
/// the target (planner/sketch/rim.hpp) take the drone nearest in coordinate space, then every other drone the nearest
/// slot that is free; ties by index. Two flat formations are compared as they are drawn, each in its plane (what is
/// farther away on the ground is higher up when upright); else in space.
/// Spare slots are no part of the picture: where there are some, all other slots take drones, rim first, and who is
/// left goes to the spare slots by the least sum of squared distances.
/// Where forbidden pairs leave a drone without slot, others make room (maximum_matching.hpp).
/// @param spare  by slot, or empty. Properties: (1) a bijection that keeps the rules (2) moving and enlarging either
/// formation changes nothing, where no slot is spare (3) same input, same result. Cost: 10,000 drones about 0.1 s.
/// Errors: infeasible when the rules admit no matching; stopped.
Result<Assignment> assign_formation_coordinates(std::span<const Vec3> from_m, std::span<const Vec3> to_m,
                                                const std::vector<bool>& spare, const MatchRules& rules,
                                                const SeparationMetric& metric, const Run& run);

}  // namespace aerogram::planner
