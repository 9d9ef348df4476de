#pragma once
#include <cstddef>
#include <vector>

#include "geo/run.hpp"
#include "geo/vec3.hpp"
#include "planner/sampling/density_raster.hpp"

namespace aerogram::planner {

/// The smallest distance between two points; infinite for fewer than two. O(n) for points spread about evenly.
[[nodiscard]] double smallest_distance(const std::vector<Vec2>& points);

/// Widens the smallest distance of points that are about evenly spread: pairs nearer than a target push each other
/// apart, the target falling from what a perfect lattice would have to what can be reached; the round with the widest
/// smallest distance is kept.
/// @param points  the first `fixed` stay. @param within  movable points stay in its cells, each the share of it that is
/// inside the area.
/// @param ideal  > 0: the target's start.
/// Properties: (1) the smallest distance never falls (2) deterministic. Cost: O(n) a round.
void push_apart(std::vector<Vec2>& points, std::size_t fixed, const DensityRaster& within, double ideal,
                std::size_t rounds, const Run& run);

}  // namespace aerogram::planner
