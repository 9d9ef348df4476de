#pragma once
#include "planner/mesh/triangle_mesh.hpp"
#include "planner/sampling/region.hpp"

namespace aerogram::planner {

/// Closed surfaces in a box one unit wide, deep and high around (0, 0, 0) unless said otherwise; z is up.
[[nodiscard]] TriangleMesh cube_mesh();
[[nodiscard]] TriangleMesh sphere_mesh();
/// The upper half of a sphere, half a unit high; closed by its floor only when `floor`.
[[nodiscard]] TriangleMesh dome_mesh(bool floor);
[[nodiscard]] TriangleMesh cylinder_mesh();
[[nodiscard]] TriangleMesh cone_mesh();
/// Lying flat, its height that of its tube. @param tube  the tube's width as a share of the whole, in (0, 0.5).
[[nodiscard]] TriangleMesh torus_mesh(double tube);

/// A region extruded along y, upright (its y is z), the middle of the depth at y = 0. Closed.
/// @param region  of positive area. @param depth  > 0.
[[nodiscard]] TriangleMesh extruded(const Region& region, double depth);

}  // namespace aerogram::planner
