#pragma once
#include <span>

#include "planner/transition/rigid_graph.hpp"

namespace aerogram::planner {

/// Solves L x = b for a graph's weighted Laplacian by conjugate gradients, preconditioned by the diagonal, until the
/// rest is 1e-11 of b. For graphs without small separators (everybody a neighbour of somebody far away), where a
/// factorisation fills up and few rounds are needed. Fixed order of summation.
/// @param b  by individual; sums to zero over each component.  @returns x up to a constant in each component.
[[nodiscard]] Points laplacian_gradients(const RingGraph& graph, std::span<const Vec3> b);

}  // namespace aerogram::planner
