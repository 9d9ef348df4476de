#pragma once
#include <cstddef>
#include <vector>

#include "geo/run.hpp"
#include "geo/vec3.hpp"
#include "planner/sampling/density_raster.hpp"

namespace aerogram::planner {

/// Moves sites to the centres of mass of their Voronoi cells, round by round (Lloyd 1982), the cells measured on the
/// raster: the centroidal Voronoi tessellation, which is also the coverage control of Cortés et al. 2004.
/// @param sites  at least one; the first `fixed` stay where they are but own their cells.
/// @param density  with some mass.
/// In the first rounds sites with little mass move beside those with much of it, as Lloyd's moves are local.
/// Properties: (1) the number of sites and the fixed ones stay (2) once no site jumps, the coverage cost never rises by
/// more than the raster's rounding (3) deterministic. Cost: O(cells of mass + sites) a round.
void relax(std::vector<Vec2>& sites, std::size_t fixed, const DensityRaster& density, std::size_t rounds,
           const Run& run);

/// The coverage cost: integral of the squared distance to the nearest site, weighted by the density.
[[nodiscard]] double coverage_cost(const std::vector<Vec2>& sites, const DensityRaster& density);

/// How far a place is from the nearest site, on average: paper 003, equation 4, divided by the number of places.
/// @param sites  at least one. @param area  with some mass; a cell counts by its mass.
[[nodiscard]] double mean_distance(const std::vector<Vec2>& sites, const DensityRaster& area);

/// `count` places spread by mass along a line that folds through the area (Hilbert's curve): a start for relax.
[[nodiscard]] std::vector<Vec2> spread_by_mass(const DensityRaster& density, std::size_t count);

}  // namespace aerogram::planner
