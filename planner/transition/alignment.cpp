#include "planner/transition/alignment.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "geo/contract.hpp"

namespace aerogram::planner {
namespace {

constexpr double kRound = 1e-6;     // moments closer than this share of the largest are equal
constexpr double kRankLoss = 1e-9;  // singular values below this share of the largest are 0
constexpr double kTraceTie = 1e-9;

double root_sum_of_squares(std::span<const Vec3> points) {
    double sum = 0.0;
    for (const Vec3& p : points) sum += glm::dot(p, p);
    return std::sqrt(sum);
}

/// The rotation from three source axes and three target axes, both right-handed.
Mat3 onto(const Mat3& source_axes, const Mat3& target_axes) {
    Mat3 out = zero3();
    for (std::size_t i = 0; i < 3; ++i) out.add_outer(source_axes.columns[i], target_axes.columns[i]);
    return out;
}

/// The right-handed triple of two nearly orthonormal vectors.
Mat3 completed(const Vec3& first, const Vec3& second) {
    const Vec3 a = glm::normalize(first), b = glm::normalize(second - glm::dot(second, a) * a);
    return Mat3{{a, b, glm::cross(a, b)}};
}

Turn kabsch(std::span<const Vec3> source_m, std::span<const Vec3> target_m) {
    Mat3 correlation = zero3();
    for (std::size_t i = 0; i < source_m.size(); ++i) correlation.add_outer(source_m[i], target_m[i]);
    const Svd3 svd = singular_values(correlation);
    const double scale = root_sum_of_squares(source_m) * root_sum_of_squares(target_m);
    if (!(svd.values[0] > kRankLoss * scale)) return {};
    const auto &u = svd.u.columns, &v = svd.v.columns;
    if (svd.values[1] <= kRankLoss * svd.values[0]) return shortest_turn(v[0], u[0], thinnest_axis(source_m));
    const bool mirrored = glm::dot(glm::cross(u[0], u[1]), u[2]) * glm::dot(glm::cross(v[0], v[1]), v[2]) < 0.0;
    const bool tied = svd.values[1] - svd.values[2] <= kRound * svd.values[0];
    if (mirrored && tied) return {};
    return turn_of(onto(completed(u[0], u[1]), completed(v[0], v[1])));
}

bool is_round(const PrincipalAxes& p) {
    const double least_gap = kRound * p.moments[0];
    return p.moments[0] - p.moments[1] <= least_gap || p.moments[1] - p.moments[2] <= least_gap;
}

double trace(const Mat3& m) {
    return m.columns[0].x + m.columns[1].y + m.columns[2].z;
}

/// Nothing where the principal axes do not decide.
std::optional<Turn> by_principal_axes(std::span<const Vec3> source_m, std::span<const Vec3> target_m) {
    const PrincipalAxes source = principal_axes(source_m), target = principal_axes(target_m);
    if (is_round(source) || is_round(target)) return std::nullopt;
    Mat3 best;
    double best_trace = -2.0, next_trace = -2.0;  // a rotation's trace is 1 + 2 cos(angle) >= -1
    for (const Vec3 signs : {Vec3{1, 1, 1}, Vec3{1, -1, -1}, Vec3{-1, 1, -1}, Vec3{-1, -1, 1}}) {
        const auto& axes = source.axes.columns;
        const Mat3 candidate = onto(Mat3{{axes[0] * signs.x, axes[1] * signs.y, axes[2] * signs.z}}, target.axes);
        if (trace(candidate) > best_trace) {
            next_trace = best_trace;
            best_trace = trace(candidate);
            best = candidate;
        } else {
            next_trace = std::max(next_trace, trace(candidate));
        }
    }
    if (best_trace - next_trace <= kTraceTie) return std::nullopt;
    return turn_of(best);
}

}  // namespace

Vec3 barycentre(std::span<const Vec3> points_m) {
    Vec3 sum{};
    for (const Vec3& p : points_m) sum += p;
    return points_m.empty() ? sum : sum / static_cast<double>(points_m.size());
}

Vec3 oriented(const Vec3& axis, std::span<const Vec3> centred_m) {
    const double size = root_sum_of_squares(centred_m), tolerance = 1e-6 * size;
    for (const Vec3& p : centred_m) {
        const double side = glm::dot(axis, p);
        if (std::abs(side) > tolerance) return side > 0.0 ? axis : -axis;
    }
    for (std::size_t i = 0; i < centred_m.size(); ++i) {
        if (glm::length(centred_m[i]) <= tolerance) continue;
        for (std::size_t j = i + 1; j < centred_m.size(); ++j) {
            const double side = glm::dot(axis, glm::cross(centred_m[i], centred_m[j]));
            if (std::abs(side) > tolerance * size) return side > 0.0 ? axis : -axis;
        }
        break;
    }
    for (const double side : {axis.y, axis.x, axis.z}) {
        if (std::abs(side) > 1e-6) return side > 0.0 ? axis : -axis;
    }
    return axis;
}

Vec3 thinnest_axis(std::span<const Vec3> centred_m) {
    const PrincipalAxes p = principal_axes(centred_m);
    if (p.moments[1] - p.moments[2] <= kRound * p.moments[0]) return {0, 1, 0};
    return oriented(p.axes.columns[2], centred_m);
}

Turn alignment_turn(std::span<const Vec3> source_m, std::span<const Vec3> target_m, Align align) {
    AEROGRAM_REQUIRE(source_m.size() == target_m.size(), source_m.size(), target_m.size());
    if (align == Align::none) return {};
    std::optional<Turn> turn;
    if (align == Align::pca) turn = by_principal_axes(source_m, target_m);
    if (!turn) turn = kabsch(source_m, target_m);
    if (is_half_turn(*turn)) turn->axis = oriented(turn->axis, source_m);
    return *turn;
}

}  // namespace aerogram::planner
