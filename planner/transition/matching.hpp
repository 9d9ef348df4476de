#pragma once
#include <vector>

#include "planner/mission/mission.hpp"
#include "planner/transition/eigenbasis.hpp"

namespace aerogram::planner {

/// Two bases made ready to turn into one another.
struct MatchedBases {
    dense::Matrix source, target;  ///< modes; column k of the target belongs to column k of the source
    dense::Matrix turn;  ///< sourceᵀ target, in SO(n - 1): the transition's rotation in the source's own axes
};

/// Matches a target basis to a source basis: target eigenspaces are turned onto the matched source columns' span
/// (orthogonal Procrustes), columns reordered, signs chosen so that inner products are >= 0; when that leaves
/// determinant -1, the one column with the smallest |inner product| (the first of equals) changes its sign. Reorder:
/// greedy takes for each source mode in turn the free target mode with the largest |inner product|; optimal maximises
/// their sum exactly; max_min makes the smallest of them as large as can be (the paper's improvement on greedy) and, of
/// such matchings, the sum; none keeps the order of eigenvalues. Scores count in steps of 2^-30, so that what is equal
/// by symmetry is equal, and ties go to the lower index. Bases of fewer than n - 1 modes: the same; turn is then no
/// rotation but the part of one, determinant >= 0.
/// @param source_spaces  eigenspaces of the source whose basis may still be turned; empty: the source is kept as it is.
/// Properties: (1) target columns stay in their eigenspaces (2) determinant +1 (3) equal bases give turn = I.
/// Source: Takahashi et al. 2009, sections 3.2 and 4.2; DESIGN.md 7.1-7.3.
[[nodiscard]] MatchedBases matched_bases(dense::Matrix source, const std::vector<Eigenspace>& source_spaces,
                                         const Eigenbasis& target, Reorder reorder);

}  // namespace aerogram::planner
