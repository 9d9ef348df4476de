#pragma once
#include "planner/adjacency/adjacency.hpp"
#include "planner/transition/dense.hpp"

namespace aerogram::planner {

/// How much each free vertex goes along when a fixed one is shifted: the harmonic extension over the mean of two
/// graphs, that is every free vertex is at the weighted mean of its neighbours.
/// @param free  the first `free` vertices of both graphs are free, the others fixed.
/// @returns free x fixed shares >= 0.
/// Properties: (1) a row sums to 1, or to 0 where nothing joins the vertex to a fixed one (2) with one fixed vertex all
/// shares are 1 or 0 (3) harmonic: weighted mean of the neighbours' to 1e-9.
[[nodiscard]] dense::Matrix harmonic_pull(const AdjacencyGraph& source, const AdjacencyGraph& target, std::size_t free);

}  // namespace aerogram::planner
