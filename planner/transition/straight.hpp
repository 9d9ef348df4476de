#pragma once
#include "planner/motion/act.hpp"
#include "planner/motion/profile.hpp"

namespace aerogram::planner {

/// Straight, synchronised flight of the fleet: drone i from from_m[i] to to_m[i].
/// @param rows  K >= 7 control rows.
[[nodiscard]] Straight straight_transition(Points from_m, Points to_m, ProfileKind profile, std::size_t rows);

}  // namespace aerogram::planner
