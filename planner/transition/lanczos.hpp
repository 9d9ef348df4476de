#pragma once
#include <cstddef>
#include <vector>

#include "geo/result.hpp"
#include "geo/run.hpp"
#include "planner/adjacency/adjacency.hpp"
#include "planner/transition/dense.hpp"

namespace aerogram::planner {

/// The lowest modes of one connected graph; no eigenvalue below known_below is missing.
struct LowModes {
    std::vector<double> values;  ///< ascending, without the constant's 0
    dense::Matrix vectors;       ///< orthonormal columns, each with sum 0
    double known_below = 0.0;
};

/// Block Lanczos on the inverse Laplacian, see low_modes.hpp: at least `count` modes up to the first gap wider than
/// gap, but no more than twice as many; where there is no such gap, those up to the last gap before.
/// @param graph  connected, n > 2 count + a few.  Errors: stopped.
[[nodiscard]] Result<LowModes> lanczos_low_modes(const AdjacencyGraph& graph, std::size_t count, double gap,
                                                 const Run& run);

/// The largest eigenvalue of a Laplacian, from below by a few per cent (power iteration); 0 without edges.
[[nodiscard]] double largest_eigenvalue(const AdjacencyGraph& graph);

}  // namespace aerogram::planner
