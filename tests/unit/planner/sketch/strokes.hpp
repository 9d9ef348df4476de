#pragma once
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "geo/random.hpp"
#include "geo/units.hpp"
#include "planner/sketch/sketched_formation.hpp"

/// Drawings for the tests of sketches.
namespace aerogram::planner::testing {

inline SketchStroke circle(const Vec2& center, double radius, bool exclusive = false) {
    SketchStroke stroke{{}, true, exclusive};
    for (int k = 0; k < 180; ++k) {
        const double angle = 2.0 * kPi * k / 180.0;
        stroke.points.push_back(center + radius * Vec2(std::cos(angle), std::sin(angle)));
    }
    return stroke;
}
inline SketchStroke box(const Vec2& low, const Vec2& high, bool exclusive = false) {
    return {{low, {high.x, low.y}, high, {low.x, high.y}}, true, exclusive};
}
inline SketchStroke open_line(std::vector<Vec2> points) {
    return {std::move(points), false, false};
}

struct NamedSketch {
    std::string name;
    std::vector<SketchStroke> strokes;
};
/// Holes, islands, crossings, disjoint areas, open lines, areas too thin for an inside.
inline std::vector<NamedSketch> sketches() {
    return {
        {"disc", {circle({0, 0}, 10)}},
        {"ring", {circle({0, 0}, 10), circle({0, 0}, 5, true)}},
        {"island", {circle({0, 0}, 10), circle({0, 0}, 7, true), circle({0, 0}, 3)}},
        {"cross", {box({0, 8}, {20, 12}), box({8, 0}, {12, 20})}},
        {"two", {circle({0, 0}, 6), circle({20, 0}, 4)}},
        {"bite", {circle({0, 0}, 10), {{{0, 0}, {14, 8}, {14, -8}}, true, true}}},
        {"face", {circle({0, 0}, 10), circle({-4, 4}, 1.5, true), open_line({{-5, -3}, {-2, -6}, {2, -6}, {5, -3}})}},
        {"lines", {open_line({{0, 0}, {10, 0}, {10, 10}}), open_line({{0, 0}, {0, 10}})}},
        {"thin", {box({0, 0}, {40, 0.5})}},
        {"bow", {{{{0, 0}, {20, 10}, {20, 0}, {0, 10}}, true, false}}},
    };
}

inline std::vector<Vec2> scattered(std::size_t n, std::uint64_t seed) {
    Random random(seed);
    std::vector<Vec2> out;
    for (std::size_t i = 0; i < n; ++i) {
        const double x = random.between(-30.0, 50.0);
        out.emplace_back(x, random.between(0.0, 20.0));
    }
    return out;
}

/// How far p is from the nearest of the paths.
inline double distance_to(const std::vector<SketchPath>& paths, const Vec2& p) {
    double best = 1e300;
    for (const SketchPath& path : paths) {
        for (std::size_t i = 0; i + 1 < path.points.size() + (path.closed ? 1 : 0); ++i) {
            const Vec2 a = path.points[i], u = path.points[(i + 1) % path.points.size()] - a;
            const double t =
                glm::dot(u, u) > 0.0 ? std::min(1.0, std::max(0.0, glm::dot(p - a, u) / glm::dot(u, u))) : 0.0;
            best = std::min(best, glm::distance(p, a + t * u));
        }
    }
    return best;
}

}  // namespace aerogram::planner::testing
