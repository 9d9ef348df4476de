#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "geo/result.hpp"
#include "planner/formation/figure.hpp"
#include "planner/sampling/region.hpp"

namespace aerogram::planner {

/// An upright figure whose points depend on its proportions and take long to find: they are sought once for
/// proportions that differ by less than one part in a hundred, and stretched by the rest.
/// @param extent  natural width and height. @param sample  the points, the box's middle at (0, 0), after stretching
/// along x and y.
[[nodiscard]] Figure flat_figure(const Vec2& extent, std::function<std::vector<Vec2>(const Vec2& stretch)> sample);

/// A region in the style that a part asks for: outline, fill (by the part's density) or solid.
/// @param region  of positive area, its y is z. Errors: as density_of and extruded_figure.
Result<Figure> area_figure(const PartRef& ref, Region region, AreaStyle style, std::optional<double> outline_share,
                           const Run& run);

/// The inside of a region, filled by `count` points (area_sampling.hpp).
/// @param region  of positive area.
[[nodiscard]] Figure filled_figure(Region region, std::size_t count, std::optional<double> outline_share,
                                   const Run& run);

/// The outline of a region by `count` points: corners first, then equal steps (stroke_sampling.hpp).
[[nodiscard]] Figure outlined_figure(Region region, std::size_t count);

}  // namespace aerogram::planner
