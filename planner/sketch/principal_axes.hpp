#pragma once
#include <array>
#include <span>

#include "geo/vec3.hpp"

namespace aerogram::planner {

/// The plane's axis along which points spread most, a unit vector with x > 0 (or x = 0, y > 0); the x axis where they
/// spread alike in all directions (to 1e-6 of the spread) or not at all. The other axis stands upright on it.
/// Closed form of the eigenvectors of the 2 x 2 covariance: the angle is half of atan2(2 cxy, cxx - cyy).
/// @param weights  empty: alike; else one >= 0 a point.
[[nodiscard]] Vec2 main_axis(std::span<const Vec2> points, const Vec2& center, std::span<const double> weights = {});

/// Eigenvectors of the covariance by falling spread, and the spreads (standard deviations). Their signs are such that
/// the largest component is positive (the first of equals); where spreads agree to 1e-6 of the largest the axes are
/// nearest to the frame's own.
struct SpaceAxes {
    std::array<Vec3, 3> axis{Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
    std::array<double, 3> spread{};
};
/// By Jacobi's rotations. Accuracy: 1e-12 of the largest spread, squared.
[[nodiscard]] SpaceAxes space_axes(std::span<const Vec3> points, const Vec3& center,
                                   std::span<const double> weights = {});

}  // namespace aerogram::planner
