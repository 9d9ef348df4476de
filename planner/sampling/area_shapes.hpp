#pragma once
#include "planner/sampling/region.hpp"

namespace aerogram::planner {

/// Areas one unit wide around (0, 0).
[[nodiscard]] Region disc_region();
/// @param inner  the hole's width as a share of the ring's, in (0, 1).
[[nodiscard]] Region ring_region(double inner);
[[nodiscard]] Region square_region();

}  // namespace aerogram::planner
