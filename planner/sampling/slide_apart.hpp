#pragma once
#include <cstddef>
#include <vector>

#include "geo/vec3.hpp"
#include "planner/sampling/region.hpp"

namespace aerogram::planner {

/// Widens the smallest distance of points on a region's contours: those nearer than a target slide apart along their
/// contours, the target falling from `ideal`; the round with the widest smallest distance is kept. So points on lines
/// that run close to each other come to stand alternately.
/// @param points  those off all contours, and those at corners that are apart, stay. @param ideal  > 0.
/// Properties: (1) the smallest distance never falls (2) points stay on their contours (3) deterministic.
/// Cost: O(segments + points) once where the segments are short, O(points) a round.
[[nodiscard]] std::vector<Vec2> slide_apart(const Region& region, std::vector<Vec2> points, double ideal,
                                            std::size_t rounds);

}  // namespace aerogram::planner
