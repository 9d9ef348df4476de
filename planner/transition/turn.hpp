#pragma once
#include <array>
#include <span>

#include "geo/vec3.hpp"

/// Small rotations and 3x3 decompositions in space.
namespace aerogram::planner {

/// A 3x3 matrix by columns.
struct Mat3 {
    std::array<Vec3, 3> columns{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

    [[nodiscard]] Vec3 operator*(const Vec3& v) const { return columns[0] * v.x + columns[1] * v.y + columns[2] * v.z; }
    /// this += a bᵀ.
    void add_outer(const Vec3& a, const Vec3& b) {
        for (int c = 0; c < 3; ++c) columns[static_cast<std::size_t>(c)] += a * b[c];
    }
};
[[nodiscard]] constexpr Mat3 zero3() {
    return Mat3{{Vec3{0, 0, 0}, Vec3{0, 0, 0}, Vec3{0, 0, 0}}};
}

/// m = u diag(values) vᵀ by one-sided Jacobi: small singular values keep their relative accuracy.
/// Columns of u whose value is exactly 0 are 0.
struct Svd3 {
    Mat3 u;
    std::array<double, 3> values{};  ///< descending
    Mat3 v;                          ///< orthonormal, of either handedness
};
[[nodiscard]] Svd3 singular_values(const Mat3& m);

/// The principal axes of centred points: eigenvectors of Σ p pᵀ, right-handed, by descending moment; m².
struct PrincipalAxes {
    Mat3 axes;
    std::array<double, 3> moments{};
};
[[nodiscard]] PrincipalAxes principal_axes(std::span<const Vec3> centred_m);

/// A rotation by angle_rad in [0, pi] about a unit axis, so that its powers need only a factor on the angle.
struct Turn {
    Vec3 axis{0, 0, 1};
    double angle_rad = 0.0;

    [[nodiscard]] Turn inverse() const { return {-axis, angle_rad}; }
};
/// v after the share `exponent` of the turn: R^exponent v.
[[nodiscard]] Vec3 turned(const Turn& turn, double exponent, const Vec3& v);

/// @param rotation  a proper rotation. Half turns (to 1e-9 rad) have two axes: the returned one has either sign.
[[nodiscard]] Turn turn_of(const Mat3& rotation);
/// True within 1e-9 rad of pi, where the axis' sign has to be chosen.
[[nodiscard]] bool is_half_turn(const Turn& turn);

/// The shortest turn from one unit vector to another; opposite ones go about the part of `hint` square to them.
[[nodiscard]] Turn shortest_turn(const Vec3& from, const Vec3& to, const Vec3& hint);
/// The unit part of v square to the unit vector u; when shorter than 1e-3 of v, that of show y, then show x.
[[nodiscard]] Vec3 square_to(const Vec3& u, const Vec3& v);

}  // namespace aerogram::planner
