#pragma once
#include <cstddef>
#include <vector>

#include "geo/vec3.hpp"

namespace aerogram::planner {

/// Points between the ends of one line of a drawing.
/// The points divide the path equally, unless they would come closer than 3/4 of their gap to `others`, as where two
/// lines meet at an acute angle: then the first and the last gap become 3/4 to 3 times as wide as suits the smallest
/// spacing best, and the points between them stay equally spaced.
/// @param path  at least two points, of positive length. @param others  the points that stand already. @param count
/// >= 1.
/// @returns the points in the order of the path.
[[nodiscard]] std::vector<Vec2> points_along(const std::vector<Vec2>& path, std::size_t count,
                                             const std::vector<Vec2>& others);

/// How many of `count` points go between the ends of each line so that the smallest gap is as wide as can be: the next
/// one always goes where the gaps are then the widest; ties go to the earlier line.
/// @param lengths  at least one. Cost: O(count * log lines).
[[nodiscard]] std::vector<std::size_t> points_inside(const std::vector<double>& lengths, std::size_t count);

[[nodiscard]] double length_of(const std::vector<Vec2>& path);

}  // namespace aerogram::planner
