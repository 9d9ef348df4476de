#pragma once
#include <span>
#include <vector>

#include "geo/vec3.hpp"

namespace aerogram::planner {

/// Chords along cubic Bézier curves joined end to end, both ends of each curve included.
/// @param control  3n + 1 points, of a closed line 3n. @param tolerance  > 0: how far a chord may stray from its curve.
[[nodiscard]] std::vector<Vec2> flattened(std::span<const Vec2> control, bool closed, double tolerance);

}  // namespace aerogram::planner
