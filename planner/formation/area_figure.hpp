#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "geo/result.hpp"
#include "planner/formation/figure.hpp"
#include "planner/sampling/density_field.hpp"
#include "planner/sampling/region.hpp"

namespace aerogram::planner {

/// An upright figure whose points depend on its proportions and take long to find: they are sought once for
/// proportions that differ by less than one part in a hundred, and stretched by the rest.
/// @param extent  natural width and height. @param sample  the points, the box's middle at (0, 0), after stretching
/// along x and y.
[[nodiscard]] Figure flat_figure(const Vec2& extent, std::function<std::vector<Vec2>(const Vec2& stretch)> sample);

/// How many cells of an area are enough to measure the coverage by `count` points.
[[nodiscard]] std::size_t places_for(std::size_t count);

/// Figure::coverage of an area by points in the plane y = 0: its places are square cells.
/// @param region  its box's middle at (0, 0). @param density  places count by it; empty: alike.
[[nodiscard]] std::function<double(const Vec3& scale, const Points& points)> area_coverage(
    std::shared_ptr<const Region> region, DensityField density);

/// A region in the style that a part asks for: outline, fill (by the part's density) or solid.
/// @param region  of positive area, its y is z. @param outline_share  fills only; with a density and without a share
/// the outline has no drones of its own.
/// Properties: (1) without a density a fill is filled_figure to the bit. Errors: as density_of and extruded_figure; a
/// density that is 0 all over the region.
Result<Figure> area_figure(const PartRef& ref, Region region, AreaStyle style, std::optional<double> outline_share,
                           const Run& run);

/// The inside of a region, filled by `count` points (area_sampling.hpp).
/// @param region  of positive area.
[[nodiscard]] Figure filled_figure(Region region, std::size_t count, std::optional<double> outline_share,
                                   const Run& run);

/// The outline of a region by `count` points: corners first, then equal steps (stroke_sampling.hpp).
[[nodiscard]] Figure outlined_figure(Region region, std::size_t count);

}  // namespace aerogram::planner
