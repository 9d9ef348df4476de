#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "geo/vec3.hpp"
#include "planner/sampling/stroke.hpp"

namespace aerogram::planner {

/// A point of a drawing that shows its shape. In order of importance when there are too few drones for all.
enum class StationKind {
    end,       ///< a free end, a corner, the top of a closed curve, or a dot
    junction,  ///< where three or more lines meet
    passage,   ///< too close to another station to be shown on its own
};
struct Station {
    Vec2 at{};
    StationKind kind = StationKind::end;
};

/// A line from one station to another (or back to itself) without a station between.
struct StrokeEdge {
    std::size_t from = 0, to = 0;  ///< into StrokeGraph::stations
    std::vector<Vec2> path;        ///< both ends included; a dot has one point
};

/// Strokes as stations joined by edges; edges are in the order in which the strokes draw them.
struct StrokeGraph {
    std::vector<Station> stations;
    std::vector<StrokeEdge> edges;
};

/// The planar graph of one letter's strokes: coincident points are one, lines are split where they cross or touch.
/// Ends of strokes within 1/40 of the cap height of another line belong to it (Hershey letters are drawn on a coarse
/// grid); features closer than 1/8 of the cap height are one station; a separate figure smaller than that is a dot; a
/// stroke that runs that close along an earlier one only thickens it and is left out. A corner turns by more than 55
/// degrees: single bends of Hershey curves reach 53, its corners begin at 63.
/// @param strokes  of one letter, any order. @param cap_height  in the strokes' unit, > 0.
[[nodiscard]] StrokeGraph stroke_graph(std::span<const Stroke> strokes, double cap_height);

/// Appends a letter's graph to a text's.
void append(StrokeGraph& text, const StrokeGraph& letter);

}  // namespace aerogram::planner
