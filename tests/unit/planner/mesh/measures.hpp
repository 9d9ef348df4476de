#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "planner/mesh/triangle_mesh.hpp"

/// Slow and simple measures of meshes and points, as oracles.
namespace aerogram::planner::testing {

/// Every edge has as many triangles on its one side as on its other.
inline bool is_closed(const TriangleMesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
    for (const auto& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = t[k], b = t[(k + 1) % 3];
            sides[std::minmax(a, b)] += a < b ? 1 : -1;
        }
    }
    return std::all_of(sides.begin(), sides.end(), [](const auto& side) { return side.second == 0; });
}

inline double whole_area(const TriangleMesh& mesh) {
    double sum = 0.0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const auto& v = mesh.vertices;
        sum += 0.5 * glm::length(glm::cross(v[b] - v[a], v[c] - v[a]));
    }
    return sum;
}

/// The distance of p from segment ab.
inline double distance_to(const Vec3& p, const Vec3& a, const Vec3& b) {
    const double squared = glm::dot(b - a, b - a);
    const double share = squared > 0.0 ? std::clamp(glm::dot(p - a, b - a) / squared, 0.0, 1.0) : 0.0;
    return glm::distance(p, a + share * (b - a));
}

/// The distance of p from triangle abc: to its plane where the foot is inside, else to its sides.
inline double distance_to(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    double out = std::min({distance_to(p, a, b), distance_to(p, b, c), distance_to(p, c, a)});
    const Vec3 across = glm::cross(b - a, c - a);
    if (glm::length(across) <= 0.0) return out;
    const Vec3 n = glm::normalize(across), foot = p - glm::dot(p - a, n) * n;
    const bool inside = glm::dot(glm::cross(b - a, foot - a), n) >= 0.0 &&
                        glm::dot(glm::cross(c - b, foot - b), n) >= 0.0 &&
                        glm::dot(glm::cross(a - c, foot - c), n) >= 0.0;
    return inside ? std::abs(glm::dot(p - a, n)) : out;
}

inline double distance_to(const Vec3& p, const TriangleMesh& mesh) {
    double smallest = 1e300;
    for (const auto& [a, b, c] : mesh.triangles) {
        smallest = std::min(smallest, distance_to(p, mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]));
    }
    return smallest;
}

inline double smallest_gap(const Points& points) {
    double smallest = 1e300;
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (std::size_t j = i + 1; j < points.size(); ++j)
            smallest = std::min(smallest, glm::distance(points[i], points[j]));
    }
    return smallest;
}

}  // namespace aerogram::planner::testing
