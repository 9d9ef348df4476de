#pragma once
#include <span>

#include "geo/vec3.hpp"

namespace aerogram::planner {

/// One mode's coefficient on its way: the norm goes linearly, the direction along the great circle at even speed.
/// Opposite directions (to 1e-7) have no unique great circle: they turn counter-clockwise about the part of `axis`
/// square to the direction (see square_to for when that vanishes). A coefficient of no more than zero_m has no
/// direction: the way is then a straight line, whose norm differs from the linear one by zero_m at most. Properties:
/// (1) at(0), at(1) are the ends to rounding error (2) |at(t)| = (1-t)|from| + t|to| to zero_m. Source: Takahashi et
/// al. 2009, equation 4 and section 4.5; DESIGN.md 7.5.
class CoefficientPath {
  public:
    CoefficientPath(const Vec3& from_m, const Vec3& to_m, const Vec3& axis, double zero_m);

    [[nodiscard]] Vec3 at(double t) const;

  private:
    Vec3 from_m_, to_m_;
    bool straight_ = false;
    double from_length_m_ = 0.0, to_length_m_ = 0.0, angle_rad_ = 0.0;
    Vec3 start_{}, side_{};  ///< orthonormal: direction(t) = cos(angle t) start + sin(angle t) side
    Vec3 miss_{};            ///< what that leaves to the end's direction, taken in by share t
};

}  // namespace aerogram::planner
