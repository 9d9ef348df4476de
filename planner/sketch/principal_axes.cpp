#include "planner/sketch/principal_axes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace aerogram::planner {
namespace {

constexpr double kAlike = 1e-6;  ///< of the variance
constexpr int kSweeps = 30;

double weight_of(std::span<const double> weights, std::size_t i) {
    return weights.empty() ? 1.0 : weights[i];
}

using Matrix = std::array<std::array<double, 3>, 3>;

/// Makes m[p][q] zero; v's columns turn with it.
void rotate(Matrix& m, Matrix& v, std::size_t p, std::size_t q) {
    if (m[p][q] == 0.0) return;
    const double theta = (m[q][q] - m[p][p]) / (2.0 * m[p][q]);
    const double t = (theta >= 0.0 ? 1.0 : -1.0) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
    const double c = 1.0 / std::sqrt(t * t + 1.0), s = t * c;
    for (std::size_t k = 0; k < 3; ++k) {
        const double kp = m[k][p], kq = m[k][q];
        m[k][p] = c * kp - s * kq;
        m[k][q] = s * kp + c * kq;
    }
    for (std::size_t k = 0; k < 3; ++k) {
        const double pk = m[p][k], qk = m[q][k];
        m[p][k] = c * pk - s * qk;
        m[q][k] = s * pk + c * qk;
        const double vp = v[k][p], vq = v[k][q];
        v[k][p] = c * vp - s * vq;
        v[k][q] = s * vp + c * vq;
    }
}

Vec3 positive(const Vec3& axis) {
    int largest = 0;
    for (int k = 1; k < 3; ++k)
        if (std::abs(axis[k]) > std::abs(axis[largest]) + 1e-9) largest = k;
    return axis[largest] < 0.0 ? -axis : axis;
}

/// The frame's axis that leans most on the plane or space upright to `taken`, made upright to them.
Vec3 own_axis(std::span<const Vec3> taken) {
    Vec3 best{};
    for (int k = 0; k < 3; ++k) {
        Vec3 axis{};
        axis[k] = 1.0;
        for (const Vec3& t : taken) axis -= glm::dot(axis, t) * t;
        if (glm::length(axis) > glm::length(best) + 1e-9) best = axis;
    }
    return glm::normalize(best);
}

}  // namespace

Vec2 main_axis(std::span<const Vec2> points, const Vec2& center, std::span<const double> weights) {
    double xx = 0.0, xy = 0.0, yy = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec2 d = points[i] - center;
        const double w = weight_of(weights, i);
        xx += w * d.x * d.x;
        xy += w * d.x * d.y;
        yy += w * d.y * d.y;
    }
    if (std::hypot(2.0 * xy, xx - yy) <= kAlike * (xx + yy)) return {1.0, 0.0};
    const double angle = 0.5 * std::atan2(2.0 * xy, xx - yy);  // in (-pi/2, pi/2]: x is never below 0
    return {std::cos(angle), std::sin(angle)};
}

SpaceAxes space_axes(std::span<const Vec3> points, const Vec3& center, std::span<const double> weights) {
    Matrix m{}, v{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    double sum = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec3 d = points[i] - center;
        const double w = weight_of(weights, i);
        sum += w;
        for (std::size_t r = 0; r < 3; ++r)
            for (std::size_t c = 0; c < 3; ++c) m[r][c] += w * d[static_cast<int>(r)] * d[static_cast<int>(c)];
    }
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
        rotate(m, v, 0, 1);
        rotate(m, v, 0, 2);
        rotate(m, v, 1, 2);
    }
    std::array<std::size_t, 3> order{0, 1, 2};
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return m[a][a] > m[b][b]; });
    SpaceAxes out;
    std::array<double, 3> variance{};
    for (std::size_t k = 0; k < 3; ++k) {
        variance[k] = sum > 0.0 ? std::max(0.0, m[order[k]][order[k]] / sum) : 0.0;
        out.spread[k] = std::sqrt(variance[k]);
        out.axis[k] = positive({v[0][order[k]], v[1][order[k]], v[2][order[k]]});
    }
    const double alike = kAlike * variance[0];
    const bool first_two = variance[0] - variance[1] <= alike, last_two = variance[1] - variance[2] <= alike;
    if (first_two && last_two) {
        out.axis = SpaceAxes{}.axis;
    } else if (first_two) {
        out.axis[0] = positive(own_axis(std::array{out.axis[2]}));
        out.axis[1] = positive(own_axis(std::array{out.axis[2], out.axis[0]}));
    } else if (last_two) {
        out.axis[1] = positive(own_axis(std::array{out.axis[0]}));
        out.axis[2] = positive(own_axis(std::array{out.axis[0], out.axis[1]}));
    }
    return out;
}

}  // namespace aerogram::planner
