#pragma once
#include <cstddef>

#include "geo/run.hpp"
#include "geo/vec3.hpp"

namespace aerogram::planner {

/// Points well spread over the surface of an ellipsoid, ordered from its top to its bottom along a spiral.
/// A golden-angle spiral is relaxed by mutual repulsion; the round with the widest smallest spacing is kept.
/// @param radii  semi-axes, > 0. @param count  >= 1.
/// Properties: (1) on the surface to 1e-12 of the radii (2) on a sphere the smallest spacing is near the best known
/// (3) deterministic. Cost: O(count) a round.
[[nodiscard]] Points spread_on_ellipsoid(const Vec3& radii, std::size_t count, const Run& run);

}  // namespace aerogram::planner
