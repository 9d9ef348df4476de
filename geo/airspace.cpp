#include "geo/airspace.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geo/contract.hpp"

namespace aerogram::geo {
namespace {

/// Twice the area of triangle abc: positive when it turns left. Wider than double so that lattice-like inputs are
/// exact.
long double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
    const long double ux = static_cast<long double>(b.x) - a.x, uy = static_cast<long double>(b.y) - a.y;
    const long double vx = static_cast<long double>(c.x) - a.x, vy = static_cast<long double>(c.y) - a.y;
    return ux * vy - uy * vx;
}

double distance_to_segment(const Vec2& a, const Vec2& b, const Vec2& p) {
    const Vec2 along = b - a;
    const double length2 = glm::dot(along, along);
    const double t = length2 > 0.0 ? std::clamp(glm::dot(p - a, along) / length2, 0.0, 1.0) : 0.0;
    return glm::length(p - (a + t * along));
}

/// Whether a ray from p towards +x crosses edge ab; each vertex belongs to one of its two edges.
bool crosses_ray(const Vec2& a, const Vec2& b, const Vec2& p) {
    if ((a.y > p.y) == (b.y > p.y)) return false;
    return (turn(a, b, p) > 0.0L) == (b.y > a.y);
}

bool in_box(const Vec2& a, const Vec2& b, const Vec2& p) {
    return p.x >= std::min(a.x, b.x) && p.x <= std::max(a.x, b.x) && p.y >= std::min(a.y, b.y) &&
           p.y <= std::max(a.y, b.y);
}

int sign(long double v) {
    return (v > 0.0L) - (v < 0.0L);
}

bool on_segment(const Vec2& a, const Vec2& b, const Vec2& p) {
    return sign(turn(a, b, p)) == 0 && in_box(a, b, p);
}

bool segments_touch(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
    if (on_segment(a, b, c) || on_segment(a, b, d) || on_segment(c, d, a) || on_segment(c, d, b)) return true;
    return sign(turn(a, b, c)) * sign(turn(a, b, d)) < 0 && sign(turn(c, d, a)) * sign(turn(c, d, b)) < 0;
}

double outside_m(const Cylinder& cylinder, const Vec2& p) {
    return glm::length(p - cylinder.center_m) - cylinder.radius_m;
}
double outside_m(const Prism& prism, const Vec2& p) {
    return -signed_distance(prism.outline_m, p);
}

}  // namespace

double signed_distance(const Polygon& polygon, const Vec2& p) {
    AEROGRAM_REQUIRE(polygon.size() >= 3, polygon.size());
    double distance_m = std::numeric_limits<double>::infinity();
    bool inside = false;
    for (std::size_t i = 0, before = polygon.size() - 1; i < polygon.size(); before = i++) {
        distance_m = std::min(distance_m, distance_to_segment(polygon[before], polygon[i], p));
        if (crosses_ray(polygon[before], polygon[i], p)) inside = !inside;
    }
    return inside ? distance_m : -distance_m;
}

double clearance(const Obstacle& obstacle, const Vec3& p) {
    const double beside_m = std::visit(
        [&](const auto& shape) {
            return outside_m(shape, Vec2{p.x, p.y});
        },
        obstacle.shape);
    const double above_m = std::max(obstacle.base_m - p.z, p.z - (obstacle.base_m + obstacle.height_m));
    if (beside_m <= 0.0 && above_m <= 0.0) return std::max(beside_m, above_m);
    return std::hypot(std::max(beside_m, 0.0), std::max(above_m, 0.0));
}

bool is_simple(const Polygon& polygon) {
    const std::size_t n = polygon.size();
    const auto finite = [](const Vec2& p) { return std::isfinite(p.x) && std::isfinite(p.y); };
    if (n < 3 || !std::ranges::all_of(polygon, finite)) return false;
    const auto at = [&](std::size_t i) { return polygon[i % n]; };
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2 a = at(i), b = at(i + 1), c = at(i + 2);
        if (a == b) return false;
        // Neighbours share b alone, unless the second lies back along the first.
        if (on_segment(a, b, c) || on_segment(b, c, a)) return false;
        for (std::size_t j = i + 2; j < n; ++j) {
            const bool neighbours = (j + 1) % n == i;
            if (!neighbours && segments_touch(a, b, at(j), at(j + 1))) return false;
        }
    }
    return true;  // such a ring encloses an area
}

}  // namespace aerogram::geo
