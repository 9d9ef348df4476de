#pragma once
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "geo/vec3.hpp"
#include "planner/transition/dense.hpp"

/// Points as three columns (all x, then all y, then all z), which is how dense products want them.
namespace aerogram::planner {

[[nodiscard]] inline Vec3 column_point(std::span<const double> columns, std::size_t i) {
    const std::size_t n = columns.size() / 3;
    return {columns[i], columns[n + i], columns[2 * n + i]};
}
inline void set_column_point(std::span<double> columns, std::size_t i, const Vec3& p) {
    const std::size_t n = columns.size() / 3;
    columns[i] = p.x;
    columns[n + i] = p.y;
    columns[2 * n + i] = p.z;
}

[[nodiscard]] inline Points centred(std::span<const Vec3> points, const Vec3& middle) {
    Points out(points.begin(), points.end());
    for (Vec3& p : out) p -= middle;
    return out;
}

/// modesᵀ points: the coefficient of each mode, metres.
[[nodiscard]] inline Points coefficients(const dense::Matrix& modes, std::span<const Vec3> centred_m) {
    std::vector<double> columns(3 * modes.rows), projected(3 * modes.columns);
    for (std::size_t i = 0; i < modes.rows; ++i) set_column_point(columns, i, centred_m[i]);
    dense::multiply(modes, dense::Op::transposed, columns, 3, projected);
    Points out(modes.columns);
    for (std::size_t k = 0; k < out.size(); ++k) out[k] = column_point(projected, k);
    return out;
}

/// The length of the whole list as one vector: RMS times √n.
[[nodiscard]] inline double frobenius(std::span<const double> values) {
    double sum = 0.0;
    for (const double x : values) sum += x * x;
    return std::sqrt(sum);
}
[[nodiscard]] inline double frobenius(std::span<const Vec3> points) {
    double sum = 0.0;
    for (const Vec3& p : points) sum += glm::dot(p, p);
    return std::sqrt(sum);
}

}  // namespace aerogram::planner
