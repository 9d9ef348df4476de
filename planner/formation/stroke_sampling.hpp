#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "planner/formation/stroke_graph.hpp"

namespace aerogram::planner {

/// Exactly `count` points on the strokes, in drawing order, after the drawing was stretched by `scale` along x and y.
/// Ends, corners, dots and tops of closed curves come first, then junctions, then points between them: each next point
/// goes to the edge with the widest gap, and the points of an edge divide it equally. With fewer points than stations
/// the kinds keep that order, and within a kind the next one is the farthest from those already taken.
/// @param scale  > 0. @param count  >= 1.
/// @returns nothing when the drawing has dots only, and fewer of them than `count`.
/// Properties: (1) count exact (2) stations occupied when count allows (3) points of one edge are equally spaced along
/// it (4) no gap could be made smaller by moving a point from one edge to another. Cost: O(count log edges).
[[nodiscard]] std::optional<std::vector<Vec2>> sample_strokes(const StrokeGraph& drawing, const Vec2& scale,
                                                              std::size_t count);

}  // namespace aerogram::planner
