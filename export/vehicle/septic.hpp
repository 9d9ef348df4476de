#pragma once
#include <array>
#include <cstddef>
#include <span>

#include "export/record/bezier.hpp"
#include "geo/vec3.hpp"

/// Polynomials of degree 7 in seconds, as a Crazyflie flies them: coefficients are floats.
namespace aerogram::exporter {

inline constexpr std::size_t kSepticTerms = 8;
using Powers = std::array<float, kSepticTerms>;

/// One piece: x, y, z and yaw are Σ c[i] t^i, t seconds from the piece's start.
struct SepticPiece {
    float duration_s = 0.0F;
    std::array<Powers, 3> place{};  ///< X front, Y left, Z up: metres
    Powers yaw{};                   ///< radians, counter-clockwise from X
};

/// Crazyflie's frame: X is away from the audience, Y to the left.
[[nodiscard]] inline Vec3 to_crazyflie(const Vec3& show) {
    return {show.y, -show.x, show.z};
}
[[nodiscard]] inline Vec3 from_crazyflie(const Vec3& p) {
    return {-p.y, p.x, p.z};
}

/// A curve of degree 7 in the show frame as powers, rounded to floats.
void set_powers(SepticPiece& piece, const Bezier& curve);
/// The curve that the floats say, show frame.
[[nodiscard]] Bezier curve_of(const SepticPiece& piece);

/// What rounding coefficients to floats may cost: metres, m/s, m/s², of each coordinate anywhere in the piece.
[[nodiscard]] std::array<double, 3> rounding_of(const SepticPiece& piece);

}  // namespace aerogram::exporter
