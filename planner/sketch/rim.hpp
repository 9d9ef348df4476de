#pragma once
#include <span>
#include <vector>

#include "geo/vec3.hpp"

namespace aerogram::planner {

/// Which points of a formation are on its rim, where its profile is seen: those whose neighbours leave a gap.
/// Neighbours are within twice the median distance to the nearest point. In a flat formation the gap is an angle of
/// more than 120 degrees in its plane, in space a cone of 60 degrees about some direction in which nobody is (looked
/// for along 200 directions and away from the neighbours' middle, so that a cone that is only just empty may be
/// missed). A point without neighbours is on the rim.
/// @param points_m  finite. Properties: (1) points of convex position are on the rim (2) the inner points of a lattice
/// are not (3) moving and enlarging the points changes nothing. Cost: O(n log n) for points spread about evenly.
[[nodiscard]] std::vector<bool> rim_of(std::span<const Vec3> points_m);

}  // namespace aerogram::planner
