#pragma once
#include <cstddef>
#include <vector>

#include "planner/adjacency/adjacency.hpp"
#include "planner/transition/dense.hpp"

namespace aerogram::planner {

/// Columns [first, last) of a basis that share one eigenvalue.
struct Eigenspace {
    std::size_t first = 0, last = 0;
    [[nodiscard]] std::size_t dimension() const { return last - first; }
};

/// The Laplacian eigenbasis of a graph without its first vector, which is (1, ..., 1)/√n exactly and is left out here:
/// n - 1 "modes", orthonormal, each with sum 0, by ascending eigenvalue.
struct Eigenbasis {
    dense::Matrix modes;             ///< n x (n - 1)
    std::vector<double> values;      ///< n - 1 eigenvalues, 1/m, ascending
    std::vector<Eigenspace> spaces;  ///< cover all columns, in order
};

/// Eigenvalues closer than this share of the largest belong to one eigenspace (and so on from neighbour to neighbour).
/// Inside one any orthonormal basis is as good: its vectors are eigenvectors to this share of the largest eigenvalue,
/// keyframes are reproduced exactly whatever the basis, and the smallest gap left keeps the eigenvectors of rigidly
/// moved input equal to 1e-9.
inline constexpr double kEigenspaceTolerance = 1e-6;

/// The constant vector is deflated by one Householder reflection before the eigenproblem is solved, so a disconnected
/// graph's kernel is completed inside the kernel. Bases are canonical: inside each eigenspace see canonical_basis.
/// @param graph  n >= 1; any connectivity.
/// Properties: (1) modesᵀ modes = I and sums 0 to 1e-13 (2) L modes = modes diag(values) to the tolerance
/// (3) the result depends on the graph, not on how the solver turned an eigenspace.
/// Source: Takahashi et al. 2009, section 3.1. O(n³).
[[nodiscard]] Eigenbasis laplacian_eigenbasis(const AdjacencyGraph& graph);

/// Neighbours in an ascending list that are within `gap` belong together.
[[nodiscard]] std::vector<Eigenspace> eigenspaces(const std::vector<double>& ascending, double gap);

/// The basis of the columns' span that depends on the span alone: the projections of coordinate vectors, largest rest
/// first (lengths within 1e-6 count as equal, then the lowest coordinate), made orthonormal. One column: its largest
/// entry is positive.
/// @param columns  orthonormal, r x m.  @returns r x m.
[[nodiscard]] dense::Matrix canonical_basis(const dense::Matrix& columns);

/// The columns [first, last).
[[nodiscard]] dense::Matrix column_block(const dense::Matrix& m, std::size_t first, std::size_t last);
/// Overwrites columns from `first` on.
void set_column_block(dense::Matrix& m, std::size_t first, const dense::Matrix& block);

}  // namespace aerogram::planner
