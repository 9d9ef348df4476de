#pragma once
#include <cstddef>
#include <vector>

#include "planner/drawing/path.hpp"

namespace aerogram::planner {

[[nodiscard]] double length_of(const Chords& lines);

/// Exactly `count` points on lines: ends, corners and crossings first, then equal steps (stroke_sampling.hpp). Features
/// closer than half of `spacing` are one; lines too many for that (3,000 chords once they are smoothed to a twentieth
/// of the spacing) are stood upon by equal steps alone, one after another.
/// @param lines  of positive length. @param spacing  > 0.
[[nodiscard]] std::vector<Vec2> line_points(const Chords& lines, std::size_t count, double spacing);

}  // namespace aerogram::planner
