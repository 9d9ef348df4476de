#pragma once
#include "planner/sampling/region.hpp"
#include "planner/sampling/stroke_graph.hpp"

namespace aerogram::planner {

/// A region's contours as lines to stand on: corners are stations, corners nearer than `close` along a contour are one,
/// halfway; a smooth contour's station is its top; a contour shorter than `close` is a dot in the middle of its box.
/// @param close  >= 0, in the region's unit. Edges run along each contour in its direction.
[[nodiscard]] StrokeGraph contour_graph(const Region& region, double close);

}  // namespace aerogram::planner
