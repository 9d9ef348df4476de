#pragma once
#include <vector>

#include "geo/vec3.hpp"

namespace aerogram::planner {

/// A line drawn without lifting the pen; x right, y up.
using Stroke = std::vector<Vec2>;

}  // namespace aerogram::planner
