#pragma once
#include <functional>
#include <span>

#include "geo/vec3.hpp"

namespace aerogram::planner {

/// Where every drone is at share t in [0, 1] of a transition: at 0 the source keyframe, at 1 the target, both to 1e-9
/// m. What every transition method returns, so that methods can be composed by group and blended. @param out  one place
/// a drone. Holds what it needs; may be called from one thread at a time.
using Interpolation = std::function<void(double t, std::span<Vec3> out)>;

}  // namespace aerogram::planner
