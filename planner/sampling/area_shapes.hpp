#pragma once
#include <cstddef>

#include "planner/sampling/region.hpp"

namespace aerogram::planner {

/// Areas whose box is one unit wide, its middle at (0, 0).
[[nodiscard]] Region disc_region();
/// @param inner  the hole's width as a share of the ring's, in (0, 1).
[[nodiscard]] Region ring_region(double inner);
[[nodiscard]] Region square_region();
/// With equal sides, standing on one. @param sides  >= 3.
[[nodiscard]] Region polygon_region(std::size_t sides);
/// One tip up. @param tips  >= 3. @param inner  how far the notches are from the middle, as a share of the tips', in
/// (0, 1).
[[nodiscard]] Region star_region(std::size_t tips, double inner);
/// Tip down: x = 16 sin³ t, y = 13 cos t - 5 cos 2t - 2 cos 3t - cos 4t.
[[nodiscard]] Region heart_region();

}  // namespace aerogram::planner
