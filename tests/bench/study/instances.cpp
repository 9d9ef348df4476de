#include "tests/bench/study/instances.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "geo/random.hpp"
#include "geo/units.hpp"

namespace aerogram::study {
namespace {

/// n of the points, those left out spread evenly.
Points thinned(const Points& points_m, std::size_t n) {
    Points kept;
    for (std::size_t i = 0; i < n; ++i) kept.push_back(points_m[i * points_m.size() / n]);
    return kept;
}

/// n places of a square lattice, row by row; along and up span it.
Points lattice(std::size_t n, const Vec3& along, const Vec3& up) {
    const auto columns = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(n))));
    Points points_m;
    for (std::size_t i = 0; i < n; ++i)
        points_m.push_back(kSpacing_m *
                           (static_cast<double>(i % columns) * along + static_cast<double>(i / columns) * up));
    return points_m;
}
Points pads(std::size_t n) {
    return lattice(n, {1, 0, 0}, {0, 1, 0});
}
Points sheet(std::size_t n) {
    Points points_m = lattice(n, {1, 0, 0}, {0, 0, 1});
    for (Vec3& p : points_m) p.z += 20.0;
    return points_m;
}

double distance_to_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
    const double t = std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
    return glm::length(p - a - t * (b - a));
}

/// Lattice places inside thick strokes of T H E, 20 high before scaling.
Points inside_letters(double scale) {
    constexpr double kHalfWidth = 1.8;
    static const std::vector<std::pair<Vec2, Vec2>> lines{
        {{-8, 20}, {8, 20}}, {{0, 20}, {0, 0}},    {{14, 0}, {14, 20}},  {{26, 0}, {26, 20}}, {{14, 10}, {26, 10}},
        {{32, 0}, {32, 20}}, {{32, 20}, {42, 20}}, {{32, 10}, {40, 10}}, {{32, 0}, {42, 0}}};
    Points points_m;
    for (double z = -kHalfWidth * scale; z <= (20.0 + kHalfWidth) * scale; z += kSpacing_m)
        for (double x = -(8.0 + kHalfWidth) * scale; x <= (42.0 + kHalfWidth) * scale; x += kSpacing_m)
            if (std::any_of(lines.begin(), lines.end(), [&](const auto& line) {
                    return distance_to_segment(Vec2{x, z} / scale, line.first, line.second) <= kHalfWidth;
                }))
                points_m.emplace_back(x, 0.0, z);
    return points_m;
}
Points letters(std::size_t n) {
    double scale = 0.9 * std::sqrt(static_cast<double>(n) * kSpacing_m * kSpacing_m / 600.0);
    Points points_m = inside_letters(scale);
    for (; points_m.size() < n; scale *= 1.005) points_m = inside_letters(scale);
    for (Vec3& p : points_m) p.z += 20.0 + 1.8 * scale;
    return thinned(points_m, n);
}

/// Golden-angle points on a sphere.
Points sphere(std::size_t n) {
    Points points_m;
    for (std::size_t i = 0; i < n; ++i) {
        const double z = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(n);
        const double a = static_cast<double>(i) * kPi * (3.0 - std::sqrt(5.0)), r = std::sqrt(1.0 - z * z);
        points_m.emplace_back(r * std::cos(a), r * std::sin(a), z);
    }
    const double radius_m = kSpacing_m / smallest_spacing_m(points_m);
    for (Vec3& p : points_m) p = radius_m * p + Vec3{0, 0, radius_m + 20.0};
    return points_m;
}

/// Circles about the origin, flat in the x-z plane.
Points circles(double inner_m, std::size_t count) {
    Points points_m;
    for (std::size_t k = 0; k < count; ++k) {
        const double r = inner_m + kSpacing_m * static_cast<double>(k);
        const double drones = std::floor(kPi / std::asin(kSpacing_m / 2.0 / r));
        for (double i = 0.0; i < drones; i += 1.0)
            points_m.emplace_back(r * std::cos(2.0 * kPi * i / drones), 0.0, r * std::sin(2.0 * kPi * i / drones));
    }
    return points_m;
}
Vec3 turned_about_x(const Vec3& p, double angle_rad) {
    const double c = std::cos(angle_rad), s = std::sin(angle_rad);
    return {p.x, c * p.y - s * p.z, s * p.y + c * p.z};
}
Points tilted_ring(std::size_t n) {
    const auto count = static_cast<std::size_t>(std::ceil(0.3 * std::sqrt(static_cast<double>(n))));
    double inner_m = kSpacing_m;
    Points points_m = circles(inner_m, count);
    for (; points_m.size() < n; inner_m += 0.1) points_m = circles(inner_m, count);
    points_m = thinned(points_m, n);
    for (Vec3& p : points_m) {
        const Vec3 q = turned_about_x(p, 0.6);
        p = Vec3{std::cos(0.2) * q.x + std::sin(0.2) * q.z, q.y, std::cos(0.2) * q.z - std::sin(0.2) * q.x + 150.0};
    }
    return points_m;
}

/// Darts thrown into a box of 40 m³ a drone; those too close to an earlier one are thrown away.
Points scattered(std::size_t n, std::uint64_t seed) {
    Random random(seed);
    const double side_m = std::cbrt(40.0 * static_cast<double>(n));
    std::map<std::tuple<long, long, long>, Points> cells;
    Points points_m;
    while (points_m.size() < n) {
        const Vec3 p{random.between(0, side_m), random.between(0, side_m), random.between(0, side_m)};
        const auto [cx, cy, cz] =
            std::tuple(std::lround(p.x / kSpacing_m), std::lround(p.y / kSpacing_m), std::lround(p.z / kSpacing_m));
        bool free = true;
        for (int k = 0; free && k < 27; ++k) {
            const auto cell = cells.find({cx + k % 3 - 1, cy + k / 3 % 3 - 1, cz + k / 9 - 1});
            if (cell == cells.end()) continue;
            for (const Vec3& q : cell->second) free = free && glm::length(p - q) >= kSpacing_m;
        }
        if (!free) continue;
        cells[{cx, cy, cz}].push_back(p);
        points_m.push_back(p);
    }
    for (Vec3& p : points_m) p.z += 20.0;
    return points_m;
}

}  // namespace

Instance make_instance(std::string_view name, std::size_t n) {
    if (name == "grid-letters") return {pads(n), letters(n)};
    if (name == "sheet-sphere") return {sheet(n), sphere(n)};
    if (name == "sheet-ring") return {sheet(n), tilted_ring(n)};
    if (name == "random") return {scattered(n, 1), scattered(n, 2)};
    throw std::invalid_argument("no instance called " + std::string(name));
}

double smallest_spacing_m(const Points& points_m) {
    Points sorted = points_m;
    std::sort(sorted.begin(), sorted.end(), [](const Vec3& a, const Vec3& b) { return a.x < b.x; });
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < sorted.size(); ++i)
        for (std::size_t j = i + 1; j < sorted.size() && sorted[j].x - sorted[i].x < smallest; ++j)
            smallest = std::min(smallest, glm::length(sorted[j] - sorted[i]));
    return smallest;
}

}  // namespace aerogram::study
