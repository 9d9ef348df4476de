#pragma once
#include <cstddef>
#include <vector>

#include "geo/vec3.hpp"
#include "planner/sampling/density_raster.hpp"

namespace aerogram::planner {

/// A closed line; the last point joins the first.
using Contour = std::vector<Vec2>;

/// A flat area bounded by contours: inside is where they wind round a point a number of times that is not 0, so that
/// holes run against the contour around them.
struct Region {
    std::vector<Contour> contours;
};

struct Bounds {
    Vec2 low{}, high{};
    [[nodiscard]] Vec2 size() const { return high - low; }
};
/// @param region  with at least one point.
[[nodiscard]] Bounds bounds_of(const Region& region);

/// Share of each cell that is inside, in [0, 1], over the region's bounds.
/// @param cells_inside  about how many cells the area shall have. Cost: O(cells + points).
/// Accuracy: exact across, four lines a cell up.
[[nodiscard]] DensityRaster rasterised(const Region& region, std::size_t cells_inside);

}  // namespace aerogram::planner
