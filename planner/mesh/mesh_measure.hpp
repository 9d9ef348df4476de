#pragma once
#include <cmath>
#include <cstdint>

#include "planner/mesh/triangle_mesh.hpp"

namespace aerogram::planner {

/// The area of one triangle.
[[nodiscard]] inline double area_of(const TriangleMesh& mesh, std::uint32_t triangle) {
    const auto& [a, b, c] = mesh.triangles[triangle];
    const Vec3& p = mesh.vertices[a];
    return 0.5 * glm::length(glm::cross(mesh.vertices[b] - p, mesh.vertices[c] - p));
}

/// The signed volume between one triangle and a place: what it adds to the enclosed volume.
[[nodiscard]] inline double cone_volume(const TriangleMesh& mesh, std::uint32_t triangle, const Vec3& from) {
    const auto& [a, b, c] = mesh.triangles[triangle];
    return glm::dot(mesh.vertices[a] - from, glm::cross(mesh.vertices[b] - from, mesh.vertices[c] - from)) / 6.0;
}

/// The volume a closed surface encloses (divergence theorem); negative when its triangles face inwards.
[[nodiscard]] inline double enclosed_volume(const TriangleMesh& mesh) {
    double sum = 0.0;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) sum += cone_volume(mesh, t, mesh.vertices.front());
    return sum;
}

/// The diagonal of the box around all vertices; 0 without any.
[[nodiscard]] inline double diagonal_of(const TriangleMesh& mesh) {
    if (mesh.vertices.empty()) return 0.0;
    Vec3 low = mesh.vertices.front(), high = low;
    for (const Vec3& v : mesh.vertices)
        for (int k = 0; k < 3; ++k) {
            low[k] = std::fmin(low[k], v[k]);
            high[k] = std::fmax(high[k], v[k]);
        }
    return glm::length(high - low);
}

}  // namespace aerogram::planner
