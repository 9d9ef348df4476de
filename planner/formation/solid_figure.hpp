#pragma once
#include <functional>

#include "geo/result.hpp"
#include "geo/run.hpp"
#include "planner/formation/figure.hpp"
#include "planner/mesh/triangle_mesh.hpp"
#include "planner/sampling/region.hpp"

namespace aerogram::planner {

/// A figure whose points depend on its proportions and take long to find: they are sought once for proportions that
/// differ by less than one part in a hundred, and stretched by the rest.
/// @param extent  natural width, depth and height. @param sample  the points, the box's middle at (0, 0, 0), after
/// stretching.
[[nodiscard]] Figure stretchable_figure(const Vec3& extent, std::function<Points(const Vec3& stretch)> sample);

/// A solid shown on its skin, in its volume or on its edges by ref.part.drones points, by the part's density.
/// @param mesh  its box's middle need not be at 0. Errors: invalid_input at the part's line: a volume of a surface that
/// encloses none (what is wrong and where), edges of a solid that has none.
Result<Figure> solid_figure(const PartRef& ref, TriangleMesh mesh, SolidStyle style, const Run& run);

/// An area extruded by part.size.depth_m and shown on its skin: both faces and the walls between them.
/// @param region  of positive area, its y is z.
Result<Figure> extruded_figure(const PartRef& ref, const Region& region, const Run& run);

}  // namespace aerogram::planner
