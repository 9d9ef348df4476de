#pragma once
#include <memory>
#include <span>

#include "planner/transition/rigid_graph.hpp"

namespace aerogram::planner {

/// Solves L x = b for the weighted Laplacian L of a graph, factored once: CHOLMOD's simplicial LDLᵀ, which calls no
/// BLAS, so that the bytes do not depend on the processor. Graphs whose factor would take more than 4e9 operations are
/// solved by conjugate gradients instead. May be called from one thread at a time.
class LaplacianSolver {
  public:
    explicit LaplacianSolver(const RingGraph& graph);
    LaplacianSolver(LaplacianSolver&&) noexcept;
    LaplacianSolver& operator=(LaplacianSolver&&) noexcept;
    ~LaplacianSolver();

    /// @param b_to_x  by individual; sums to zero over each component; becomes x, up to a constant in each.
    void solve(std::span<Vec3> b_to_x);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace aerogram::planner
