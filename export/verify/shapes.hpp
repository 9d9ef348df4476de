#pragma once
#include "export/record/bezier.hpp"
#include "geo/airspace.hpp"

/// Verify's own plane geometry: where a point or a piece of curve is, seen from a polygon or an obstacle.
namespace aerogram::exporter {

/// By the even-odd rule; points on the edge may count either way. @param outline  >= 3 vertices.
[[nodiscard]] bool inside(const geo::Polygon& outline, const Vec2& p);
/// Smallest distance of the segment from a to b (a point when equal) to the outline's edges; 0 when it crosses one.
[[nodiscard]] double edge_distance(const geo::Polygon& outline, const Vec2& a, const Vec2& b);
[[nodiscard]] double segment_distance(const Vec2& p, const Vec2& a, const Vec2& b);

/// Distance to the outline: positive inside, negative outside.
[[nodiscard]] double inner_margin(const geo::Polygon& outline, const Vec2& p);
/// A number the inner margin of the curve (x, y) is nowhere below.
[[nodiscard]] double inner_margin_bound(const geo::Polygon& outline, const Bezier& curve);
/// A number the outer margin (positive outside) of the curve (x, y) is nowhere below.
[[nodiscard]] double outer_margin_bound(const geo::Polygon& outline, const Bezier& curve);

/// Distance to a solid: positive outside.
[[nodiscard]] double solid_margin(const geo::Obstacle& solid, const Vec3& p);
/// A number the distance of the curve to the solid is nowhere below.
[[nodiscard]] double solid_margin_bound(const geo::Obstacle& solid, const Bezier& curve);

}  // namespace aerogram::exporter
