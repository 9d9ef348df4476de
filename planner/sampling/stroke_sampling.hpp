#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "planner/sampling/stroke_graph.hpp"

namespace aerogram::planner {

/// Exactly `count` points on the strokes, in drawing order, after the drawing was stretched by `scale` along x and y.
/// Ends, corners, dots and tops of closed curves come first, then junctions, then points between them: each next point
/// goes to the edge whose gaps are then the widest, and the points of an edge divide it equally, save near acute angles
/// (edge_placing.hpp). With fewer points than stations the kinds keep that order, and within a kind the next one is the
/// farthest from those already taken.
/// @param scale  > 0. @param count  >= 1.
/// @returns nothing when the drawing has dots only, and fewer of them than `count`.
/// Properties: (1) count exact (2) stations occupied when count allows (3) the inner points of one edge are equally
/// spaced along it (4) no other numbers of points on the edges, equally spaced, would have a wider smallest gap. Cost:
/// O(count * (log edges + edges)).
[[nodiscard]] std::optional<std::vector<Vec2>> sample_strokes(const StrokeGraph& drawing, const Vec2& scale,
                                                              std::size_t count);

}  // namespace aerogram::planner
