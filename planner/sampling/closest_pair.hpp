#pragma once
#include <cstddef>

#include "geo/limits.hpp"
#include "geo/vec3.hpp"

namespace aerogram::planner {

/// Smallest distance between any two points in the separation metric, and between which; hash grid, O(n).
struct ClosestPair {
    std::size_t first = 0, second = 0;
    double distance_m = 0.0;
};
/// @param points_m  n >= 2 finite points.
[[nodiscard]] ClosestPair closest_pair(const Points& points_m, const SeparationMetric& metric);

}  // namespace aerogram::planner
