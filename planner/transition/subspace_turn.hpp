#pragma once
#include "planner/transition/dense.hpp"
#include "planner/transition/eigenbasis.hpp"

namespace aerogram::planner {

/// A rotation of n-space that is the identity outside the span of `basis`: basis turn basisᵀ inside.
struct SubspaceTurn {
    dense::Matrix basis;  ///< n x d, orthonormal; its first columns are the source
    dense::Matrix turn;   ///< d x d, in SO(d)
};

/// The rotation inside the span of both that takes every source column to the target's, and what is left of the span by
/// the smallest turn: with principal pairs T v = cos S u + sin q (q square to S) that is q -> cos q - sin S u. Pairs
/// square to one another to rounding have no order; they are paired as closely as they come.
/// @param source, target  n x k, orthonormal.  @param overlap  sourceᵀ target, determinant >= 0.
/// Properties: (1) turn in SO(d), k <= d <= 2k (2) basis turn takes source column j to target column j to 1e-6 (pairs
/// closer than that count as one), to 1e-12 else (3) k = n - 1 columns that span the same: turn = overlap.
/// Source: Davis and Kahan 1970 (the direct rotation).
[[nodiscard]] SubspaceTurn subspace_turn(const dense::Matrix& source, const dense::Matrix& target,
                                         const dense::Matrix& overlap);

/// The first `count` columns of a basis; of an eigenspace that this would cut, the part nearest to the other basis.
[[nodiscard]] Eigenbasis reduced_basis(const Eigenbasis& basis, std::size_t count, const Eigenbasis& other);

}  // namespace aerogram::planner
