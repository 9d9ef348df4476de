#pragma once
#include <cstddef>
#include <vector>

namespace aerogram::planner {

/// Solves (I + lambda D₂ᵀD₂) X = C in place, D₂ the second difference along the rows: the Sobolev filter that spreads a
/// correction over about lambda^(1/4) rows. Rows marked fixed stay zero; at held knots the curve of the rows,
/// (X[k] + 4 X[k+1] + X[k+2]) / 6, stays zero (Lagrange multipliers, so X is as smooth as the filter makes it).
/// One pentadiagonal LDLᵀ for all columns, kLanes of them side by side.
class SobolevSmoother {
  public:
    static constexpr std::size_t kLanes = 24;

    /// @param fixed  one flag a row.  @param held_knots  k of each, distinct, away from fixed rows.
    SobolevSmoother(const std::vector<bool>& fixed, double lambda, std::vector<std::size_t> held_knots = {});
    /// @param block  rows times kLanes values, row by row; what fixed rows hold does not matter.
    void apply(double* block) const;

  private:
    void filter(double* block) const;

    std::size_t rows_;
    std::vector<double> free_;                                   ///< 1 for rows that may move, else 0
    std::vector<double> inverse_pivot_, below_one_, below_two_;  ///< 1 / D, and L's two sub-diagonals
    std::vector<std::size_t> held_;
    std::vector<std::vector<double>>
        spread_;                ///< of each held knot: what filtering its weights (1, 4, 1)/6 gives, by row
    std::vector<double> gram_;  ///< Cholesky factor of the held knots' responses to each other, row-major
};

}  // namespace aerogram::planner
