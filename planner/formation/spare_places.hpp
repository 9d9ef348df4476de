#pragma once
#include <cstddef>
#include <string>

#include "geo/result.hpp"
#include "geo/vec3.hpp"
#include "planner/mission/mission.hpp"

namespace aerogram::planner {

/// Where `count` drones wait that a keyframe does not need, as fleet.spares says: above the last pads, where take-off
/// ends; in upright columns left and right of the formation, in its range of heights; or in an upright sheet behind it
/// (several where one is full), spread over its box.
/// @param formation_m  the keyframe's slots, at least one.
/// Properties: (1) count exact (2) no two of slots and places are nearer than limits.formation_spacing_m, if the slots
/// are not (3) deterministic.
/// Errors: invalid_input when too few pads are clear of the formation (what to write instead, without file and line).
Result<Points> spare_places(const Mission& mission, const Points& formation_m, std::size_t count);

/// "12 spare drones wait above their pads".
[[nodiscard]] std::string describe_spares(Spares where, std::size_t count);

}  // namespace aerogram::planner
