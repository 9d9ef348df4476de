#pragma once
#include <cstddef>
#include <vector>

#include "geo/vec3.hpp"
#include "planner/sketch/sketch_region.hpp"

namespace aerogram::planner {

/// Points evenly along paths: their corners (sharper than 30 degrees) and ends, and between two of those equal steps of
/// about `unit`, from 3/4 of it upwards. A point that would come nearer to another than 0.7 units is left out, a corner
/// never for a point between corners.
/// @param unit  > 0; made larger where there would be more than 200,000 steps. Source: paper 002, section 3.2 ("evenly
/// re-sampling all the sketch curves"). Properties: (1) every point is on a path (2) no two are nearer than 0.7 units
/// (3) path by path, in its direction. Cost: O(points of the paths + length / unit).
[[nodiscard]] std::vector<Vec2> resampled(const std::vector<SketchPath>& paths, double unit);

/// Exactly `count` points likewise, the steps as alike as a whole number of them a piece allows. Where there are more
/// corners than points the sharpest keep theirs; where there are more paths than points the longest ones do.
/// @param count  >= 1. @param paths  at least one, of positive length.
/// Properties: (1) count exact (2) every point is on a path.
[[nodiscard]] std::vector<Vec2> resampled_exactly(const std::vector<SketchPath>& paths, std::size_t count);

}  // namespace aerogram::planner
