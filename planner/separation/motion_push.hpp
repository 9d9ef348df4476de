#pragma once
#include <cstddef>

#include "planner/separation/projection.hpp"

namespace aerogram::planner {

/// Control rows that an act may have here (a flow of 600 keyframes has 10,000).
inline constexpr std::size_t kMostRows = 16'384;

/// Pushes one drone's control rows towards speed and acceleration limits: differences of rows that are too long are
/// shortened, in such measure that what comes out of the Sobolev filter is about the excess (DESIGN.md 8, 3).
class MotionPush {
  public:
    /// @param width  W of the filter.  @param gain  by which filtered corrections are multiplied.
    MotionPush(const MotionLimits& motion, double width, double gain);

    /// The worst of each quantity over its limit: 1 is at a limit. @param x, y, z  rows of one drone.
    [[nodiscard]] double ratio(const double* x, const double* y, const double* z, std::size_t rows) const;
    /// Adds corrections for every difference above its limit.
    void push(const double* x, const double* y, const double* z, std::size_t rows, double* cx, double* cy,
              double* cz) const;

  private:
    double horizontal_m_, up_m_, down_m_, bend_m_;  ///< limits of ΔP and Δ²P
    double speed_weight_, bend_weight_;
};

}  // namespace aerogram::planner
