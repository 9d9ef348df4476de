#pragma once
#include <span>
#include <vector>

#include "planner/leg_motion.hpp"

namespace aerogram::planner {

/// Ways flown one after the other.
struct Ways {
    std::vector<Leg> legs;
    std::vector<LegMotion> motions;
};

/// The way home that is always safe: every arrival and every moving hold backwards, from the last formation to where
/// take-off ended. What was kept apart on the way out is kept apart on the way back.
/// @param legs, motions  of the whole route, as they will be flown.
/// Properties: (1) ends where the return should (2) the same curves, separations and margins as on the way out.
[[nodiscard]] Ways retrace(const Mission& mission, const Route& route, std::span<const Leg> legs,
                           std::span<const LegMotion> motions);

}  // namespace aerogram::planner
