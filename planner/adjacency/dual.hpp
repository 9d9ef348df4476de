#pragma once
#include <span>

#include "geo/vec3.hpp"

namespace aerogram::planner {

/// How firmly two points are neighbours: the length of their common Voronoi edge (plane), or the width (twice area over
/// perimeter) of their common Voronoi face (space), as far as it lies within reach_m of the pair's midpoint. 0 when
/// points on one circle or sphere merely tie.
/// @param ring_m  the points that close a Delaunay triangle with the pair.
/// Properties: (1) rigid motions leave it alone (2) 0 exactly when no ball within reach touches the pair and holds no
/// ring point inside.
double dual_length_m(const Vec2& p_m, const Vec2& q_m, std::span<const Vec2> ring_m, double reach_m);
double dual_width_m(const Vec3& p_m, const Vec3& q_m, std::span<const Vec3> ring_m, double reach_m);

}  // namespace aerogram::planner
