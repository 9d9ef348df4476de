#pragma once
#include <span>
#include <vector>

#include "geo/vec3.hpp"

namespace aerogram::planner {

/// Solves (I + lambda D₂ᵀD₂) X = C in place, D₂ the second difference along the rows: the Sobolev filter that spreads a
/// correction over about lambda^(1/4) rows. Rows marked fixed stay zero. One pentadiagonal LDLᵀ for all columns.
class SobolevSmoother {
  public:
    /// @param fixed  one flag a row.
    SobolevSmoother(std::vector<bool> fixed, double lambda);
    /// @param rows_by_columns  row-major, rows = fixed.size().
    void apply(std::span<Vec3> rows_by_columns) const;

  private:
    std::vector<bool> fixed_;
    std::vector<double> pivot_, below_one_, below_two_;  ///< D, and L's two sub-diagonals
};

}  // namespace aerogram::planner
