#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "planner/sampling/stroke.hpp"

namespace aerogram::planner {

/// A straight piece of line between two vertices.
struct StrokePiece {
    std::size_t from = 0, to = 0;
};

/// Strokes cut into pieces that meet at their ends only; pieces are distinct and in drawing order.
struct StrokePieces {
    std::vector<Vec2> vertices;
    std::vector<StrokePiece> pieces;
};

/// Cuts strokes where they cross, touch or overlap. Ends of strokes within `snap` of another stroke are moved onto it.
[[nodiscard]] StrokePieces cut_strokes(std::vector<Stroke> strokes, double snap);

/// The strokes without those that run within `distance` of one earlier stroke along their whole length.
[[nodiscard]] std::vector<Stroke> without_thickening(std::span<const Stroke> strokes, double distance);

}  // namespace aerogram::planner
