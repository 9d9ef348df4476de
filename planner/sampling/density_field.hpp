#pragma once
#include <functional>

#include "geo/vec3.hpp"

namespace aerogram::planner {

/// How densely a place of a natural figure (before it is stretched, box's middle at 0) is to be filled, >= 0; where it
/// is twice as high, twice as many. Empty: alike everywhere.
using DensityField = std::function<double(const Vec3& natural)>;

}  // namespace aerogram::planner
