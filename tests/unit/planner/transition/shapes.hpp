#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "geo/random.hpp"
#include "planner/transition/dense.hpp"
#include "planner/transition/spectral.hpp"
#include "planner/transition/turn.hpp"

/// Formations, graphs and motions for the tests of this folder.
namespace aerogram::planner::testing {

class Random : public aerogram::Random {
  public:
    using aerogram::Random::Random;
    Vec3 in_cube(double half) { return {between(-half, half), between(-half, half), between(-half, half)}; }
    Vec3 direction() {
        for (;;) {
            const Vec3 v = in_cube(1.0);
            const double length = glm::length(v);
            if (length > 0.1 && length <= 1.0) return v / length;
        }
    }
};

/// How often a property is tried; AEROGRAM_TEST_N scales it.
inline int tries(int usual) {
    const char* scale = std::getenv("AEROGRAM_TEST_N");
    return scale == nullptr ? usual : std::max(1, static_cast<int>(usual * std::atof(scale)));
}

struct RigidMotion {
    Turn turn;
    Vec3 shift_m{};
    Vec3 operator()(const Vec3& p) const { return turned(turn, 1.0, p) + shift_m; }
    Points operator()(const Points& points) const {
        Points out;
        for (const Vec3& p : points) out.push_back((*this)(p));
        return out;
    }
};
inline RigidMotion random_motion(Random& random) {
    return {{random.direction(), random.between(0.1, 3.0)}, random.in_cube(50.0)};
}

/// Every point joined to its k nearest, weighted 1/d.
inline AdjacencyGraph nearest_graph(const Points& points, std::size_t k) {
    AdjacencyGraph graph{points.size(), {}};
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (std::size_t i = 0; i < points.size(); ++i) {
        std::vector<std::pair<std::int64_t, std::uint32_t>> near;  // distances in whole micrometres: ties by index
        for (std::size_t j = 0; j < points.size(); ++j) {
            if (j != i)
                near.emplace_back(std::llround(1e6 * glm::distance(points[i], points[j])),
                                  static_cast<std::uint32_t>(j));
        }
        std::sort(near.begin(), near.end());
        for (std::size_t j = 0; j < std::min(k, near.size()); ++j) {
            pairs.push_back(std::minmax(static_cast<std::uint32_t>(i), near[j].second));
        }
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    for (const auto& [a, b] : pairs) graph.edges.push_back({a, b, 1.0 / glm::distance(points[a], points[b])});
    return graph;
}
inline AdjacencyGraph full_graph(const Points& points) {
    return nearest_graph(points, points.size());
}
/// Every pair with the same weight: one eigenspace beside the constant vector.
inline AdjacencyGraph complete_graph(std::size_t n) {
    AdjacencyGraph graph{n, {}};
    for (std::uint32_t a = 0; a < n; ++a) {
        for (std::uint32_t b = a + 1; b < n; ++b) graph.edges.push_back({a, b, 1.0});
    }
    return graph;
}
inline AdjacencyGraph cycle_graph(std::size_t n) {
    AdjacencyGraph graph{n, {}};
    for (std::uint32_t a = 0; a + 1 < n; ++a) {
        graph.edges.push_back({a, a + 1, 1.0});
        if (a == 0) graph.edges.push_back({0, static_cast<std::uint32_t>(n - 1), 1.0});
    }
    return graph;
}

inline SpectralKeyframe keyframe(Points points, std::size_t neighbours = 5) {
    AdjacencyGraph graph = nearest_graph(points, neighbours);
    return {std::move(points), std::move(graph)};
}
inline Points random_points(Random& random, std::size_t n, double half = 10.0) {
    Points out(n);
    for (Vec3& p : out) p = random.in_cube(half);
    return out;
}
inline Points ring(std::size_t n, double radius, double phase = 0.0) {
    Points out;
    for (std::size_t i = 0; i < n; ++i) {
        const double a = phase + 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
        out.push_back({radius * std::cos(a), 0.0, radius * std::sin(a)});
    }
    return out;
}
/// n points in equal steps along strokes in the x-z plane.
inline Points strokes(const std::vector<std::pair<Vec3, Vec3>>& lines, std::size_t n) {
    double total = 0.0;
    for (const auto& [a, b] : lines) total += glm::distance(a, b);
    Points out;
    for (std::size_t i = 0; i < n; ++i) {
        double along = total * (static_cast<double>(i) + 0.5) / static_cast<double>(n);
        for (const auto& [a, b] : lines) {
            const double length = glm::distance(a, b);
            if (along <= length || &b == &lines.back().second) {
                out.push_back(a + (b - a) * (along / length));
                break;
            }
            along -= length;
        }
    }
    return out;
}
inline Points letter_t(std::size_t n) {
    return strokes({{{-6, 0, 8}, {6, 0, 8}}, {{0, 0, 8}, {0, 0, -8}}}, n);
}
inline Points letter_h(std::size_t n) {
    return strokes({{{-6, 0, 8}, {-6, 0, -8}}, {{-6, 0, 0}, {6, 0, 0}}, {{6, 0, 8}, {6, 0, -8}}}, n);
}
inline Points letter_e(std::size_t n) {
    return strokes(
        {{{6, 0, 8}, {-6, 0, 8}}, {{-6, 0, 8}, {-6, 0, -8}}, {{-6, 0, -8}, {6, 0, -8}}, {{-6, 0, 0}, {4, 0, 0}}}, n);
}

inline double largest_distance(std::span<const Vec3> a, std::span<const Vec3> b) {
    double worst = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, glm::distance(a[i], b[i]));
    return worst;
}
inline Points positions(const SpectralTransition& transition, std::size_t n, double t) {
    Points out(n);
    transition.at(t, out);
    return out;
}
inline SpectralTransition built(const SpectralKeyframe& source, const SpectralKeyframe& target,
                                const SpectralOptions& options = {}) {
    auto result = SpectralTransition::between(source, target, options, Run{});
    return std::move(result).value();
}

// Plain matrix algebra, apart from the seam that is tested.
inline dense::Matrix identity(std::size_t n) {
    dense::Matrix out(n, n);
    for (std::size_t i = 0; i < n; ++i) out(i, i) = 1.0;
    return out;
}
inline dense::Matrix times(const dense::Matrix& a, const dense::Matrix& b) {
    dense::Matrix out(a.rows, b.columns);
    for (std::size_t j = 0; j < b.columns; ++j) {
        for (std::size_t k = 0; k < a.columns; ++k) {
            for (std::size_t i = 0; i < a.rows; ++i) out(i, j) += a(i, k) * b(k, j);
        }
    }
    return out;
}
inline dense::Matrix transposed(const dense::Matrix& a) {
    dense::Matrix out(a.columns, a.rows);
    for (std::size_t j = 0; j < a.columns; ++j) {
        for (std::size_t i = 0; i < a.rows; ++i) out(j, i) = a(i, j);
    }
    return out;
}
inline double largest_difference(const dense::Matrix& a, const dense::Matrix& b) {
    if (a.rows != b.rows || a.columns != b.columns) return 1e300;
    double worst = 0.0;
    for (std::size_t i = 0; i < a.values.size(); ++i) worst = std::max(worst, std::abs(a.values[i] - b.values[i]));
    return worst;
}
/// Orthonormal columns by Gram-Schmidt, twice.
inline dense::Matrix random_basis(Random& random, std::size_t n) {
    dense::Matrix q(n, n);
    for (std::size_t j = 0; j < n; ++j) {
        for (double& x : q.column(j)) x = random.between(-1.0, 1.0);
        for (int pass = 0; pass < 2; ++pass) {
            for (std::size_t k = 0; k < j; ++k) {
                double along = 0.0;
                for (std::size_t i = 0; i < n; ++i) along += q(i, k) * q(i, j);
                for (std::size_t i = 0; i < n; ++i) q(i, j) -= along * q(i, k);
            }
        }
        double length = 0.0;
        for (const double x : q.column(j)) length += x * x;
        for (double& x : q.column(j)) x /= std::sqrt(length);
    }
    return q;
}
/// The rotation by angles[p] in the planes of columns 2p, 2p + 1 of a basis, to the power t.
inline dense::Matrix rotation_in_planes(const dense::Matrix& basis, const std::vector<double>& angles, double t) {
    dense::Matrix turn = identity(basis.columns);
    for (std::size_t p = 0; p < angles.size(); ++p) {
        const double c = std::cos(t * angles[p]), s = std::sin(t * angles[p]);
        turn(2 * p, 2 * p) = turn(2 * p + 1, 2 * p + 1) = c;
        turn(2 * p + 1, 2 * p) = s;
        turn(2 * p, 2 * p + 1) = -s;
    }
    return times(times(basis, turn), transposed(basis));
}

}  // namespace aerogram::planner::testing
