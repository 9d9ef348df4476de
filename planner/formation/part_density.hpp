#pragma once
#include "geo/result.hpp"
#include "planner/formation/figure.hpp"
#include "planner/sampling/density_field.hpp"

namespace aerogram::planner {

/// A part's density map over its natural figure, whose box's middle is at 0; empty where the map is even.
/// @param extent  natural width, depth, height. Brush strokes need a size given with the part (the reader sees to it).
/// Errors: as read_picture, at the part's line.
Result<DensityField> density_of(const PartRef& ref, const Vec3& extent);

}  // namespace aerogram::planner
