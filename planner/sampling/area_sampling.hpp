#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "geo/run.hpp"
#include "geo/vec3.hpp"
#include "planner/sampling/density_raster.hpp"
#include "planner/sampling/region.hpp"

namespace aerogram::planner {

/// Exactly `count` points in a region: corners and equal steps along its outline, the others spread evenly inside by
/// Lloyd's relaxation and then pushed apart.
/// @param region  of positive area, at its final proportions. @param count  >= 1.
/// @param outline_share  how much of the points goes to the outline, [0, 1]; absent: as many as give the outline and
/// the inside one spacing, which is the root of paper 002's equation (boundary_count.hpp) to a tenth.
/// Properties: (1) count exact (2) inside the region, to a fifth of the spacing (3) without a share: corners occupied
/// where they are farther apart than the spacing (4) deterministic. Outline points first, each contour in its
/// direction. Cost: 10,000 points 0.5 s.
[[nodiscard]] std::vector<Vec2> sample_region(const Region& region, std::size_t count,
                                              std::optional<double> outline_share, const Run& run);

/// Exactly `count` points in a region, spread by a density: where it is twice as high, twice as many.
/// @param density  >= 0 at places of the region; a region that is 0 all over counts as even.
/// @param outline_share  this much of the points goes to the outline in equal steps, save where the density is 0;
/// absent: none is put there.
/// Properties: (1) count exact (2) inside the region, to a fifth of the mean spacing (4) deterministic.
[[nodiscard]] std::vector<Vec2> sample_region(const Region& region, std::size_t count,
                                              std::optional<double> outline_share,
                                              const std::function<double(const Vec2&)>& density, const Run& run);

/// Exactly `count` points spread evenly over the cells that have mass, however much.
/// @param area  with some mass; a cell that is only partly inside has that share.
[[nodiscard]] std::vector<Vec2> sample_evenly(const DensityRaster& area, std::size_t count, const Run& run);

/// Exactly `count` points spread by a density: where it is twice as high, twice as many.
/// @param density  with some mass.
[[nodiscard]] std::vector<Vec2> sample_density(const DensityRaster& density, std::size_t count, const Run& run);

/// How many raster cells of mass are fine enough for `count` points.
[[nodiscard]] std::size_t cells_for(std::size_t count);

}  // namespace aerogram::planner
