#pragma once
#include "geo/result.hpp"
#include "geo/run.hpp"
#include "planner/formation/figure.hpp"
#include "planner/mesh/triangle_mesh.hpp"
#include "planner/sampling/region.hpp"

namespace aerogram::planner {

/// A solid shown on its skin, in its volume or on its edges by ref.part.drones points, by the part's density.
/// @param mesh  its box's middle need not be at 0. Errors: invalid_input at the part's line: a volume of a surface that
/// encloses none (what is wrong and where), edges of a solid that has none.
Result<Figure> solid_figure(const PartRef& ref, TriangleMesh mesh, SolidStyle style, const Run& run);

/// An area extruded by part.size.depth_m and shown on its skin: both faces and the walls between them.
/// @param region  of positive area, its y is z.
Result<Figure> extruded_figure(const PartRef& ref, const Region& region, const Run& run);

}  // namespace aerogram::planner
