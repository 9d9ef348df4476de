#include "export/verify/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace aerogram::exporter {
namespace {

Vec2 flat(const Vec3& p) {
    return {p.x, p.y};
}
double cross(const Vec2& a, const Vec2& b) {
    return a.x * b.y - a.y * b.x;
}

bool crosses(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
    const double ca = cross(b - a, c - a), da = cross(b - a, d - a);
    const double ac = cross(d - c, a - c), bc = cross(d - c, b - c);
    return ((ca > 0.0) != (da > 0.0)) && ((ac > 0.0) != (bc > 0.0));
}

/// How far the curve strays from its chord, at most: x and y.
double stray(const Bezier& curve) {
    double most = 0.0;
    for (const Vec3& p : curve.controls()) {
        most = std::max(most, segment_distance(flat(p), flat(curve.front()), flat(curve.back())));
    }
    return most;
}

/// How far the curve gets from a point, at most: x and y.
double reach(const Bezier& curve, const Vec2& from) {
    double most = 0.0;
    for (const Vec3& p : curve.controls()) most = std::max(most, glm::length(flat(p) - from));
    return most;
}

/// The margin on the wanted side of the outline: the chord's distance to the edges less the curve's stray when the
/// whole curve is certainly on that side, else what the middle's margin leaves.
double side_bound(const geo::Polygon& outline, const Bezier& curve, bool wanted_inside) {
    const Vec2 middle = flat(value(curve, 0.5));
    if (inside(outline, middle) == wanted_inside) {
        const double clear = edge_distance(outline, flat(curve.front()), flat(curve.back())) - stray(curve);
        if (clear > 0.0) return clear;
    }
    const double margin = inner_margin(outline, middle);
    return (wanted_inside ? margin : -margin) - reach(curve, middle);
}

double outer_margin(const geo::Cylinder& cylinder, const Vec2& p) {
    return glm::length(p - cylinder.center_m) - cylinder.radius_m;
}
double outer_margin(const geo::Prism& prism, const Vec2& p) {
    return -inner_margin(prism.outline_m, p);
}
double footprint_bound(const geo::Cylinder& cylinder, const Bezier& curve) {
    return segment_distance(cylinder.center_m, flat(curve.front()), flat(curve.back())) - stray(curve) -
           cylinder.radius_m;
}
double footprint_bound(const geo::Prism& prism, const Bezier& curve) {
    return outer_margin_bound(prism.outline_m, curve);
}

double combined(double beside, double above_or_below) {
    if (beside > 0.0 && above_or_below > 0.0) return std::hypot(beside, above_or_below);
    return std::max(beside, above_or_below);
}

}  // namespace

double segment_distance(const Vec2& p, const Vec2& a, const Vec2& b) {
    const Vec2 along = b - a;
    const double length2 = glm::dot(along, along);
    const double share = length2 > 0.0 ? std::clamp(glm::dot(p - a, along) / length2, 0.0, 1.0) : 0.0;
    return glm::length(p - (a + share * along));
}

bool inside(const geo::Polygon& outline, const Vec2& p) {
    bool odd = false;
    for (std::size_t i = 0, before = outline.size() - 1; i < outline.size(); before = i++) {
        const Vec2 &a = outline[before], &b = outline[i];
        if ((a.y > p.y) == (b.y > p.y)) continue;
        if (p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) odd = !odd;
    }
    return odd;
}

double edge_distance(const geo::Polygon& outline, const Vec2& a, const Vec2& b) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0, before = outline.size() - 1; i < outline.size(); before = i++) {
        const Vec2 &c = outline[before], &d = outline[i];
        if (crosses(a, b, c, d)) return 0.0;
        nearest = std::min({nearest, segment_distance(a, c, d), segment_distance(b, c, d), segment_distance(c, a, b),
                            segment_distance(d, a, b)});
    }
    return nearest;
}

double inner_margin(const geo::Polygon& outline, const Vec2& p) {
    const double distance = edge_distance(outline, p, p);
    return inside(outline, p) ? distance : -distance;
}

double inner_margin_bound(const geo::Polygon& outline, const Bezier& curve) {
    return side_bound(outline, curve, true);
}

double outer_margin_bound(const geo::Polygon& outline, const Bezier& curve) {
    return side_bound(outline, curve, false);
}

double solid_margin(const geo::Obstacle& solid, const Vec3& p) {
    const double beside = std::visit([&](const auto& shape) { return outer_margin(shape, flat(p)); }, solid.shape);
    return combined(beside, std::max(solid.base_m - p.z, p.z - (solid.base_m + solid.height_m)));
}

double solid_margin_bound(const geo::Obstacle& solid, const Bezier& curve) {
    const double beside = std::visit([&](const auto& shape) { return footprint_bound(shape, curve); }, solid.shape);
    const auto [low, high] = std::ranges::minmax(curve.controls(), {}, &Vec3::z);
    return combined(beside, std::max(solid.base_m - high.z, low.z - (solid.base_m + solid.height_m)));
}

}  // namespace aerogram::exporter
