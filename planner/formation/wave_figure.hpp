#pragma once
#include <cstddef>

#include "geo/run.hpp"
#include "planner/formation/figure.hpp"

namespace aerogram::planner {

/// A sheet over the ground whose height is a sine along x, beginning on the left half way up and climbing: `waves`
/// crests and as many troughs. Its points are spread evenly over the sheet, corners and rim occupied, as a
/// rectangle's (area_sampling.hpp) once the sheet is unrolled.
/// @param drones  >= 1. @param waves  > 0.
/// Properties: (1) count exact (2) on the sheet to 1e-6 of its height (3) deterministic.
[[nodiscard]] Figure wave_figure(std::size_t drones, double waves, const Run& run);

}  // namespace aerogram::planner
