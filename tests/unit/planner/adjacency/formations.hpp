#pragma once
#include <cmath>
#include <cstdint>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "geo/random.hpp"
#include "geo/units.hpp"
#include "planner/adjacency/adjacency.hpp"

namespace aerogram::planner::testing {

class Random : public aerogram::Random {
  public:
    using aerogram::Random::Random;
    double in(double low, double high) { return between(low, high); }
    Vec3 in_box(double half) { return {in(-half, half), in(-half, half), in(-half, half)}; }
};

/// Turned about x, y, z in that order, then moved.
struct Motion {
    Vec3 turn_rad{};
    Vec3 shift_m{};

    Vec3 operator()(Vec3 p) const {
        const auto turn = [](double& u, double& v, double angle) {
            const double c = std::cos(angle), s = std::sin(angle), u0 = u;
            u = c * u0 - s * v;
            v = s * u0 + c * v;
        };
        turn(p.y, p.z, turn_rad.x);
        turn(p.z, p.x, turn_rad.y);
        turn(p.x, p.y, turn_rad.z);
        return p + shift_m;
    }
    Points operator()(const Points& points) const {
        Points moved;
        for (const Vec3& p : points) moved.push_back((*this)(p));
        return moved;
    }
};

inline Points random_points(std::size_t n, std::uint64_t seed, double half = 10.0) {
    Random random(seed);
    Points points;
    for (std::size_t i = 0; i < n; ++i) points.push_back(random.in_box(half));
    return points;
}

/// columns x rows in the x-z plane, `spacing` apart.
inline Points grid(std::size_t columns, std::size_t rows, double spacing) {
    Points points;
    for (std::size_t r = 0; r < rows; ++r)
        for (std::size_t c = 0; c < columns; ++c)
            points.emplace_back(static_cast<double>(c) * spacing, 0.0, static_cast<double>(r) * spacing);
    return points;
}

/// Strokes in the x-z plane, points two metres apart, corners shared.
inline Points strokes(const std::vector<std::pair<Vec2, Vec2>>& lines) {
    Points points;
    for (const auto& [from, to] : lines) {
        const auto steps = static_cast<int>(std::lround(glm::length(to - from) / 2.0));
        for (int k = 0; k <= steps; ++k) {
            const Vec2 p = from + (to - from) * (static_cast<double>(k) / steps);
            const Vec3 q{p.x, 0.0, p.y};
            bool known = false;
            for (const Vec3& other : points) known = known || glm::length(other - q) < 0.5;
            if (!known) points.push_back(q);
        }
    }
    return points;
}
inline Points letter_t() {
    return strokes({{{-8, 20}, {8, 20}}, {{0, 20}, {0, 0}}});
}
inline Points letter_h() {
    return strokes({{{-6, 0}, {-6, 20}}, {{6, 0}, {6, 20}}, {{-6, 10}, {6, 10}}});
}
inline Points letter_e() {
    return strokes({{{0, 0}, {0, 20}}, {{0, 20}, {10, 20}}, {{0, 10}, {8, 10}}, {{0, 0}, {10, 0}}});
}
inline Points letter_n() {
    return strokes({{{0, 0}, {0, 20}}, {{0, 20}, {10, 0}}, {{10, 0}, {10, 20}}});
}

inline Points circle(std::size_t n, double radius) {
    Points points;
    for (std::size_t i = 0; i < n; ++i) {
        const double a = 2.0 * kPi * static_cast<double>(i) / static_cast<double>(n);
        points.emplace_back(radius * std::cos(a), 0.0, radius * std::sin(a));
    }
    return points;
}

/// Golden-angle points on a sphere.
inline Points sphere(std::size_t n, double radius) {
    Points points;
    for (std::size_t i = 0; i < n; ++i) {
        const double z = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(n);
        const double a = static_cast<double>(i) * kPi * (3.0 - std::sqrt(5.0)), r = std::sqrt(1.0 - z * z);
        points.emplace_back(radius * r * std::cos(a), radius * r * std::sin(a), radius * z);
    }
    return points;
}

inline Points cube(std::size_t side, double spacing) {
    Points points;
    for (std::size_t i = 0; i < side * side * side; ++i)
        points.push_back(Vec3{static_cast<double>(i % side), static_cast<double>(i / side % side),
                              static_cast<double>(i / (side * side))} *
                         spacing);
    return points;
}

using Pairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;
inline Pairs pairs_of(const AdjacencyGraph& graph) {
    Pairs pairs;
    for (const Edge& e : graph.edges) pairs.emplace(e.a, e.b);
    return pairs;
}

inline bool is_connected(const AdjacencyGraph& graph) {
    std::vector<std::uint32_t> set(graph.n);
    std::iota(set.begin(), set.end(), 0U);
    for (std::size_t round = 0; round < graph.n; ++round) {
        bool changed = false;
        for (const Edge& e : graph.edges) {
            const std::uint32_t low = std::min(set[e.a], set[e.b]);
            changed = changed || set[e.a] != low || set[e.b] != low;
            set[e.a] = set[e.b] = low;
        }
        if (!changed) break;
    }
    return std::set<std::uint32_t>(set.begin(), set.end()).size() <= 1;
}

}  // namespace aerogram::planner::testing
