#pragma once
#include <array>
#include <cstddef>
#include <span>
#include <utility>

#include "geo/vec3.hpp"

/// Bézier polynomials of degree 0..7 over u in [0, 1], as files store them.
namespace aerogram::exporter {

inline constexpr std::size_t kMaxDegree = 7;

struct Bezier {
    std::array<Vec3, kMaxDegree + 1> control{};
    std::size_t degree = 0;  ///< 0 .. kMaxDegree

    [[nodiscard]] std::span<const Vec3> controls() const { return {control.data(), degree + 1}; }
    [[nodiscard]] const Vec3& front() const { return control[0]; }
    [[nodiscard]] const Vec3& back() const { return control[degree]; }
};

/// The curve's point at u (de Casteljau; u a little outside [0, 1] continues the polynomial).
[[nodiscard]] Vec3 value(const Bezier& curve, double u);
/// The derivative with respect to u: degree one less, degree 0 (zero) for a constant.
[[nodiscard]] Bezier derivative(const Bezier& curve);
/// The same curve written with a higher degree. @param degree  curve.degree .. kMaxDegree
[[nodiscard]] Bezier elevated(const Bezier& curve, std::size_t degree);
/// The curve on [0, u] and on [u, 1], each again over [0, 1].
[[nodiscard]] std::pair<Bezier, Bezier> split(const Bezier& curve, double u);
/// The curve on [from, to], again over [0, 1]. @param to  > 0, >= from
[[nodiscard]] Bezier restricted(const Bezier& curve, double from, double to);

}  // namespace aerogram::exporter
