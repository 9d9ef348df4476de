#pragma once
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "geo/vec3.hpp"

namespace aerogram::planner {

/// Points by component, so that loops over many of them run side by side.
struct Coordinates {
    std::vector<double> x, y, z;

    explicit Coordinates(std::size_t n = 0) : x(n), y(n), z(n) {}
    [[nodiscard]] std::size_t size() const { return x.size(); }
    [[nodiscard]] Vec3 operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
    void set(std::size_t i, const Vec3& p) {
        x[i] = p.x;
        y[i] = p.y;
        z[i] = p.z;
    }
};

/// The points in the separation metric, about their barycentre (which no optimal assignment depends on).
inline Coordinates centred(std::span<const Vec3> points_m, const SeparationMetric& metric) {
    Vec3 center_m{};
    for (const Vec3& p : points_m) center_m += p / static_cast<double>(points_m.size());
    Coordinates coordinates(points_m.size());
    for (std::size_t i = 0; i < points_m.size(); ++i) coordinates.set(i, metric.scaled(points_m[i] - center_m));
    return coordinates;
}

/// The largest distance from the origin.
inline double radius_of(const Coordinates& c) {
    double radius = 0.0;
    for (std::size_t i = 0; i < c.size(); ++i) radius = std::max(radius, glm::length(c[i]));
    return radius;
}

}  // namespace aerogram::planner
