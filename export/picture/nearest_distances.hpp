#pragma once
#include <vector>

#include "geo/vec3.hpp"

namespace aerogram::exporter {

/// How far each point's nearest other point is, in metres of the separation metric.
/// @param points_m  finite. @returns one a point; of a single point an empty list.
/// Accuracy and cost: exact; O(n log n) for any points, coincident and collinear ones too.
[[nodiscard]] std::vector<double> nearest_distances(const Points& points_m, const SeparationMetric& metric);

}  // namespace aerogram::exporter
