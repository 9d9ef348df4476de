#pragma once
#include <span>
#include <vector>

#include "planner/transition/dense.hpp"

namespace aerogram::planner {

/// Real powers of a rotation of n-space, taken apart into planes that each turn by their own angle: R = Z rot(angles)
/// Zᵀ. Planes come from the eigenvectors of the symmetric part (R + Rᵀ)/2; eigenvalues cos θ closer than min(1e-3,
/// 1/(4n)) form a cluster, inside which a small real Schur form separates the planes, so that no angle is read from a
/// cosine alone. Where θ = π (to 1e-11) the plane is not unique: the eigenspace's canonical basis is paired in order.
/// Properties: (1) R^1 = R to 1e-10 (2) R^s R^t = R^(s+t) to 1e-12 (3) R^t is a rotation.
/// Source: DESIGN.md 7.4; no matrix logarithm is taken.
class PlaneRotation {
  public:
    /// @param rotation  orthogonal to rounding error, determinant +1.
    explicit PlaneRotation(const dense::Matrix& rotation);

    [[nodiscard]] std::size_t dimension() const { return axes_.columns; }
    /// Z: columns 2p and 2p + 1 span plane p, the columns after the last plane stay where they are.
    [[nodiscard]] const dense::Matrix& axes() const { return axes_; }
    /// One angle a plane, (0, pi].
    [[nodiscard]] const std::vector<double>& angles_rad() const { return angles_rad_; }

    /// rot(angles)^exponent on coordinates along the axes. @param y  dimension() x columns, column-major; overwritten.
    void turn_coordinates(double exponent, std::span<double> y, std::size_t columns) const;
    /// R^exponent, dense.
    [[nodiscard]] dense::Matrix power(double exponent) const;

  private:
    dense::Matrix axes_;
    std::vector<double> angles_rad_;
};

}  // namespace aerogram::planner
