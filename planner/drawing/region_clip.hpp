#pragma once
#include <optional>
#include <span>
#include <vector>

#include "planner/drawing/path.hpp"
#include "planner/sampling/region.hpp"

/// Areas combined exactly. Results have contours that do not cross, outer ones counter-clockwise, holes clockwise; a
/// place is in the result by winding number as by parity. Points are rounded to 1e-9 of the box of all that goes in.
/// Each returns nothing where it would cost too much: more than about 10^8 pairs of edges side by side, or 4 million
/// that could cross. Contours of less than 1e-12 of the box's area are gone. Deterministic.
namespace aerogram::planner {

enum class FillRule { nonzero, evenodd };

/// The same area by contours that do not cross.
[[nodiscard]] std::optional<Region> simplified(const Region& region, FillRule rule);

/// What is in any of the regions; those far from one another are not compared.
[[nodiscard]] std::optional<Region> united(std::span<const Region> regions);
/// What is in `from` and not in `what`.
[[nodiscard]] std::optional<Region> subtracted(const Region& from, const Region& what);
[[nodiscard]] std::optional<Region> intersected(const Region& a, const Region& b);

/// The parts of lines inside a region, or outside of it; closed lines come back open.
enum class Side { inside, outside };
[[nodiscard]] std::optional<Chords> clipped(const Chords& lines, const Region& region, Side side = Side::inside);

/// What a pen of this width covers along lines, with butt ends and mitred corners (limit 4), as SVG's defaults are: a
/// contour a piece, all counter-clockwise, for any reader of winding numbers. @param width  > 0.
[[nodiscard]] Region stroked(const Chords& lines, double width);

/// Twice the signed area of a contour, counter-clockwise > 0.
[[nodiscard]] double doubled_area(const Contour& contour);

}  // namespace aerogram::planner
