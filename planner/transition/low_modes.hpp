#pragma once
#include <cstddef>

#include "geo/result.hpp"
#include "geo/run.hpp"
#include "planner/transition/eigenbasis.hpp"

namespace aerogram::planner {

/// The modes of a Laplacian with the lowest eigenvalues, ascending: at least `count` of them, whole eigenspaces only
/// (so some more; all n - 1 when there are no more). Where the eigenspace at the cut would make it more than twice as
/// many, the cut is before it: then there are fewer, none in a graph without edges.
/// Every component of a graph is taken for itself, and the constant on each is exact: repeated eigenvalues of equal
/// components need no luck. A component of up to kDenseComponent is solved as laplacian_eigenbasis does; a larger one
/// by block Lanczos on the Laplacian's inverse (one individual held at 0; CHOLMOD), all vectors kept orthogonal twice
/// over; that no mode below the cut is missing is not trusted to luck but counted: L - s I has as many negative pivots
/// as there are eigenvalues below s.
/// Properties: (1) equal to the low part of laplacian_eigenbasis: values to 1e-9 of the largest, spans of eigenspaces
/// to 1e-6 (2) modesᵀ modes = I and sums 0 to 1e-12 (3) eigenspaces are whole (4) deterministic.
/// Errors: stopped. Cost at 10,000 individuals, 128 modes: see docs of spectral.hpp.
[[nodiscard]] Result<Eigenbasis> low_eigenbasis(const AdjacencyGraph& graph, std::size_t count, const Run& run);

inline constexpr std::size_t kDenseComponent = 600;

}  // namespace aerogram::planner
