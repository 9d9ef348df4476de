#include "planner/transition/turn.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geo/units.hpp"

namespace aerogram::planner {
namespace {

constexpr int kMostSweeps = 60;  // one-sided Jacobi needs about six

/// Turns two columns in their plane: (a, b) -> (c a - s b, s a + c b).
void rotate_pair(Vec3& a, Vec3& b, double c, double s) {
    const Vec3 old = a;
    a = c * old - s * b;
    b = s * old + c * b;
}

}  // namespace

Svd3 singular_values(const Mat3& m) {
    Mat3 work = m, v;
    for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
        bool done = true;
        for (std::size_t p = 0; p < 2; ++p) {
            for (std::size_t q = p + 1; q < 3; ++q) {
                Vec3 &a = work.columns[p], &b = work.columns[q];
                const double aa = glm::dot(a, a), bb = glm::dot(b, b), ab = glm::dot(a, b);
                if (std::abs(ab) <= std::numeric_limits<double>::epsilon() * std::sqrt(aa) * std::sqrt(bb)) continue;
                done = false;
                const double zeta = (bb - aa) / (2.0 * ab);
                const double t = (zeta >= 0.0 ? 1.0 : -1.0) / (std::abs(zeta) + std::hypot(1.0, zeta));
                const double c = 1.0 / std::hypot(1.0, t);
                rotate_pair(a, b, c, c * t);
                rotate_pair(v.columns[p], v.columns[q], c, c * t);
            }
        }
        if (done) break;
    }
    std::array<std::size_t, 3> order{0, 1, 2};
    std::array<double, 3> lengths{};
    for (std::size_t i = 0; i < 3; ++i) lengths[i] = glm::length(work.columns[i]);
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return lengths[a] > lengths[b]; });
    Svd3 out;
    for (std::size_t i = 0; i < 3; ++i) {
        out.values[i] = lengths[order[i]];
        out.v.columns[i] = v.columns[order[i]];
        out.u.columns[i] = out.values[i] > 0.0 ? work.columns[order[i]] / out.values[i] : Vec3{0, 0, 0};
    }
    return out;
}

PrincipalAxes principal_axes(std::span<const Vec3> centred_m) {
    Mat3 moments = zero3();
    for (const Vec3& p : centred_m) moments.add_outer(p, p);
    const Svd3 svd = singular_values(moments);  // symmetric and positive: v holds the eigenvectors
    PrincipalAxes out{svd.v, svd.values};
    out.axes.columns[2] = glm::cross(out.axes.columns[0], out.axes.columns[1]);
    return out;
}

Vec3 turned(const Turn& turn, double exponent, const Vec3& v) {
    const double angle = exponent * turn.angle_rad;
    const double half_sine = std::sin(0.5 * angle);
    return v + std::sin(angle) * glm::cross(turn.axis, v) +
           2.0 * half_sine * half_sine * glm::cross(turn.axis, glm::cross(turn.axis, v));
}

Turn turn_of(const Mat3& rotation) {
    const auto& [x, y, z] = rotation.columns;
    // The quaternion by its largest component.
    const std::array<double, 4> squares{1.0 + x.x + y.y + z.z, 1.0 + x.x - y.y - z.z, 1.0 - x.x + y.y - z.z,
                                        1.0 - x.x - y.y + z.z};
    const auto largest = std::max_element(squares.begin(), squares.end()) - squares.begin();
    double w = y.z - z.y;
    Vec3 v{};
    switch (largest) {
        case 0:
            w = squares[0];
            v = {y.z - z.y, z.x - x.z, x.y - y.x};
            break;
        case 1:
            v = {squares[1], x.y + y.x, z.x + x.z};
            break;
        case 2:
            w = z.x - x.z;
            v = {x.y + y.x, squares[2], y.z + z.y};
            break;
        default:
            w = x.y - y.x;
            v = {z.x + x.z, y.z + z.y, squares[3]};
            break;
    }
    const double length = glm::length(v);
    if (length == 0.0) return {};
    return {(w < 0.0 ? -v : v) / length, 2.0 * std::atan2(length, std::abs(w))};
}

bool is_half_turn(const Turn& turn) {
    return kPi - turn.angle_rad < 1e-9;
}

Vec3 square_to(const Vec3& u, const Vec3& v) {
    for (const Vec3& candidate : {v, Vec3{0, 1, 0}, Vec3{1, 0, 0}}) {
        const Vec3 across = candidate - glm::dot(candidate, u) * u;
        if (glm::length(across) > 1e-3 * glm::length(candidate)) return glm::normalize(across);
    }
    return {0, 0, 1};
}

Turn shortest_turn(const Vec3& from, const Vec3& to, const Vec3& hint) {
    const Vec3 across = glm::cross(from, to);
    const double sine = glm::length(across);
    if (sine < 1e-9) return glm::dot(from, to) > 0.0 ? Turn{} : Turn{square_to(from, hint), kPi};
    return {across / sine, std::atan2(sine, glm::dot(from, to))};
}

}  // namespace aerogram::planner
