#pragma once
#include <span>
#include <vector>

#include "geo/vec3.hpp"

namespace aerogram::planner {

/// Solves (I + lambda D₂ᵀD₂) X = C in place, D₂ the second difference along the rows: the Sobolev filter that spreads a
/// correction over about lambda^(1/4) rows. Rows marked fixed stay zero; at held knots the curve of the rows,
/// (X[k] + 4 X[k+1] + X[k+2]) / 6, stays zero (Lagrange multipliers, so X is as smooth as the filter makes it).
/// One pentadiagonal LDLᵀ for all columns.
class SobolevSmoother {
  public:
    /// @param fixed  one flag a row.  @param held_knots  k of each, distinct, away from fixed rows.
    SobolevSmoother(std::vector<bool> fixed, double lambda, std::vector<std::size_t> held_knots = {});
    /// @param rows_by_columns  row-major, rows = fixed.size().
    void apply(std::span<Vec3> rows_by_columns) const;

  private:
    void filter(std::span<Vec3> rows_by_columns) const;
    [[nodiscard]] Points responses_at(std::span<const Vec3> rows_by_columns, std::size_t column) const;

    std::vector<bool> fixed_;
    std::vector<double> pivot_, below_one_, below_two_;  ///< D, and L's two sub-diagonals
    std::vector<std::size_t> held_;
    std::vector<std::vector<double>>
        spread_;                ///< of each held knot: what filtering its weights (1, 4, 1)/6 gives, by row
    std::vector<double> gram_;  ///< Cholesky factor of the held knots' responses to each other, row-major
};

}  // namespace aerogram::planner
