#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

/// Sparse symmetric systems: this folder's door to CHOLMOD for matrices that are no plain Laplacian (see
/// sparse_cholmod.cpp). Same input: same bytes.
namespace aerogram::planner::sparse {

/// The upper triangle of a symmetric matrix by columns: column j holds entries [starts[j], starts[j + 1]), rows
/// ascending, the diagonal last and always there.
struct Symmetric {
    std::size_t n = 0;
    std::vector<int> starts;  ///< n + 1
    std::vector<int> rows;
    std::vector<double> values;
};

/// A = L D Lᵀ by CHOLMOD's simplicial factorisation, approximate minimum degree order. No pivoting: for indefinite A
/// the factor serves to count signs (Sylvester: as many negative pivots as negative eigenvalues), not to solve.
/// May be used by one thread at a time.
class Factor {
  public:
    explicit Factor(const Symmetric& matrix);
    Factor(Factor&&) noexcept;
    Factor& operator=(Factor&&) noexcept;
    ~Factor();

    /// False when a pivot was 0: then there is neither a solution nor a count.
    [[nodiscard]] bool complete() const;
    [[nodiscard]] std::size_t negative_pivots() const;
    /// A x = b. @param b_to_x  column-major, n x columns, overwritten.
    void solve(std::span<double> b_to_x, std::size_t columns);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace aerogram::planner::sparse
