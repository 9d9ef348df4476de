#pragma once
#include <cstddef>
#include <vector>

#include "geo/vec3.hpp"

namespace aerogram::planner {

/// The points that are left when, one after another, a point of the closest pair is taken away: the one whose second
/// neighbour is nearer (then the one with the higher index), until `count` are left. So the thickest places thin first
/// and the smallest spacing grows.
/// @param points  finite. @param count  <= their number.
/// @returns indices, ascending.
/// Properties: (1) count exact (2) the smallest distance of what is left is no less than before (3) deterministic.
/// Cost: O(n log n) for points spread about evenly.
[[nodiscard]] std::vector<std::size_t> thinned(const Points& points, std::size_t count);

}  // namespace aerogram::planner
