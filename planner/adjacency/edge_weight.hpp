#pragma once
#include <algorithm>

#include "planner/adjacency/adjacency.hpp"

namespace aerogram::planner {

/// The largest weight of a graph, 1/m; 1 without edges. What coincident points get, whose 1/distance is no number.
[[nodiscard]] inline double strongest_weight(const AdjacencyGraph& graph) {
    double strongest = 0.0;
    for (const Edge& e : graph.edges) strongest = std::max(strongest, e.weight);
    return strongest > 0.0 ? strongest : 1.0;
}

}  // namespace aerogram::planner
