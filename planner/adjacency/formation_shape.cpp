#include "planner/adjacency/formation_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace aerogram::planner {
namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

Vec3 barycentre(std::span<const Vec3> points_m) {
    Vec3 sum{};
    for (const Vec3& p : points_m) sum += p;
    return sum / static_cast<double>(points_m.size());
}

double radius_about(const Vec3& center_m, std::span<const Vec3> points_m) {
    double radius_m = 0.0;
    for (const Vec3& p : points_m) radius_m = std::max(radius_m, glm::length(p - center_m));
    return radius_m;
}

/// One Jacobi rotation that makes s[p][q] vanish; columns of v follow.
void rotate_out(Matrix& s, Matrix& v, std::size_t p, std::size_t q) {
    if (s[p][q] == 0.0) return;
    const double theta = (s[q][q] - s[p][p]) / (2.0 * s[p][q]);
    const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::hypot(theta, 1.0));
    const double c = 1.0 / std::hypot(t, 1.0), sine = t * c;
    for (std::size_t k = 0; k < 3; ++k) {
        const double kp = s[k][p], kq = s[k][q];
        s[k][p] = c * kp - sine * kq;
        s[k][q] = sine * kp + c * kq;
    }
    for (std::size_t k = 0; k < 3; ++k) {
        const double pk = s[p][k], qk = s[q][k];
        s[p][k] = c * pk - sine * qk;
        s[q][k] = sine * pk + c * qk;
    }
    for (std::size_t k = 0; k < 3; ++k) {
        const double kp = v[k][p], kq = v[k][q];
        v[k][p] = c * kp - sine * kq;
        v[k][q] = sine * kp + c * kq;
    }
}

/// Unit eigenvectors of a symmetric matrix, largest eigenvalue first.
std::array<Vec3, 3> principal_axes(Matrix s) {
    Matrix v{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (int sweep = 0; sweep < 30; ++sweep) {
        rotate_out(s, v, 0, 1);
        rotate_out(s, v, 0, 2);
        rotate_out(s, v, 1, 2);
    }
    std::array<std::size_t, 3> order{0, 1, 2};
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return s[a][a] > s[b][b]; });
    std::array<Vec3, 3> axes{};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t c = order[k];
        axes[k] = glm::normalize(Vec3{v[0][c], v[1][c], v[2][c]});
    }
    return axes;
}

std::array<Vec3, 3> axes_about(const Vec3& center_m, double radius_m, std::span<const Vec3> points_m) {
    Matrix covariance{};
    if (radius_m == 0.0) return principal_axes(covariance);
    for (const Vec3& p : points_m) {
        const Vec3 d = (p - center_m) / radius_m;
        for (int r = 0; r < 3; ++r)
            for (int c = 0; c < 3; ++c)
                covariance[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)] += d[r] * d[c];
    }
    return principal_axes(covariance);
}

/// Points in the order in which a plane sweeping in one fixed, unaligned direction meets them: near points are near in
/// it.
struct Sweep {
    std::vector<std::uint32_t> order;
    std::vector<double> at_m;  ///< along the direction, ascending

    explicit Sweep(std::span<const Vec3> points_m) : order(points_m.size()), at_m(points_m.size()) {
        const Vec3 direction = glm::normalize(Vec3{0.537, 0.648, 0.541});
        std::vector<double> along_m(points_m.size());
        for (std::size_t i = 0; i < points_m.size(); ++i) along_m[i] = glm::dot(points_m[i], direction);
        std::iota(order.begin(), order.end(), 0U);
        std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
            return std::pair(along_m[a], a) < std::pair(along_m[b], b);
        });
        for (std::size_t k = 0; k < order.size(); ++k) at_m[k] = along_m[order[k]];
    }
};

double median_nearest_m(std::span<const Vec3> places_m) {
    const std::size_t n = places_m.size();
    if (n < 2) return 0.0;
    const Sweep sweep(places_m);
    std::vector<double> nearest_m(n, std::numeric_limits<double>::infinity());
    for (std::size_t k = 0; k < n; ++k) {
        const Vec3& p = places_m[sweep.order[k]];
        double& best_m = nearest_m[k];
        for (std::size_t j = k + 1; j < n && sweep.at_m[j] - sweep.at_m[k] < best_m; ++j)
            best_m = std::min(best_m, glm::length(places_m[sweep.order[j]] - p));
        for (std::size_t j = k; j-- > 0 && sweep.at_m[k] - sweep.at_m[j] < best_m;)
            best_m = std::min(best_m, glm::length(places_m[sweep.order[j]] - p));
    }
    std::nth_element(nearest_m.begin(), nearest_m.begin() + static_cast<std::ptrdiff_t>(n / 2), nearest_m.end());
    return nearest_m[n / 2];
}

}  // namespace

FormationShape shape_of(std::span<const Vec3> places_m) {
    FormationShape shape;
    shape.center_m = barycentre(places_m);
    shape.radius_m = radius_about(shape.center_m, places_m);
    shape.axes = axes_about(shape.center_m, shape.radius_m, places_m);
    shape.spacing_m = median_nearest_m(places_m);
    double off_line_m = 0.0;
    for (const Vec3& p : places_m) {
        const Vec3 d = p - shape.center_m;
        const double across_m = glm::dot(d, shape.axes[1]), above_m = glm::dot(d, shape.axes[2]);
        off_line_m = std::max(off_line_m, std::hypot(across_m, above_m));
        shape.thickness_m = std::max(shape.thickness_m, std::abs(above_m));
    }
    const double flat_m = kFlatShare * shape.spacing_m;
    if (places_m.size() > 1) shape.dimension = off_line_m <= flat_m ? 1 : shape.thickness_m <= flat_m ? 2 : 3;
    return shape;
}

std::vector<std::uint32_t> same_place(std::span<const Vec3> points_m) {
    const double tolerance_m = kCoincidentShare * radius_about(barycentre(points_m), points_m);
    const Sweep sweep(points_m);
    std::vector<std::uint32_t> first(points_m.size());
    std::iota(first.begin(), first.end(), 0U);
    const auto root = [&](std::uint32_t i) {
        while (first[i] != i) i = first[i] = first[first[i]];
        return i;
    };
    for (std::size_t k = 0; k < points_m.size(); ++k)
        for (std::size_t j = k + 1; j < points_m.size() && sweep.at_m[j] - sweep.at_m[k] <= 2.0 * tolerance_m; ++j) {
            if (glm::length(points_m[sweep.order[j]] - points_m[sweep.order[k]]) > tolerance_m) continue;
            const std::uint32_t one = root(sweep.order[j]), other = root(sweep.order[k]);
            first[std::max(one, other)] = std::min(one, other);
        }
    for (std::uint32_t i = 0; i < first.size(); ++i) first[i] = root(i);
    return first;
}

}  // namespace aerogram::planner
