#pragma once
#include <vector>

#include "geo/vec3.hpp"
#include "planner/sampling/region.hpp"

namespace aerogram::planner {

/// Points that show a region's outline: its corners, and equal steps of about `spacing` (never less along the contour)
/// between them. Corners nearer to each other are one point, halfway; where the area, or a gap in it, is narrower than
/// the spacing the outline has no points, so that the inside can be spread without regard to it. Contours shorter than
/// two spacings have none.
/// @param spacing  > 0.
/// Properties: (1) every point is on a contour (2) no two are nearer than 0.98 spacings. Cost: O(points of the contours
/// + length / spacing).
[[nodiscard]] std::vector<Vec2> outline_points(const Region& region, double spacing);

}  // namespace aerogram::planner
