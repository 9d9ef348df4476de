#pragma once
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace aerogram {

/// A point or displacement; show frame (x right, y away from the audience, z up), metres, unless a name says otherwise.
using Vec3 = glm::dvec3;
using Vec2 = glm::dvec2;
using Points = std::vector<Vec3>;

/// The one separation metric of Aerogram: ‖(dx, dy, dz / downwash)‖ in metres, downwash >= 1.
/// Separations, spacings and squared assignment costs are all measured in it.
struct SeparationMetric {
    double downwash = 1.0;

    /// The displacement whose Euclidean length is the separation.
    [[nodiscard]] Vec3 scaled(const Vec3& d) const { return {d.x, d.y, d.z / downwash}; }
    /// Metres in the separation metric.
    [[nodiscard]] double length(const Vec3& d) const { return glm::length(scaled(d)); }
    [[nodiscard]] double distance(const Vec3& a, const Vec3& b) const { return length(b - a); }
};

/// True when all three components are finite.
[[nodiscard]] inline bool is_finite(const Vec3& p) {
    return p.x - p.x == 0.0 && p.y - p.y == 0.0 && p.z - p.z == 0.0;
}

}  // namespace aerogram
