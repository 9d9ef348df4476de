#pragma once
#include <span>
#include <vector>

#include "geo/tracks.hpp"
#include "planner/motion/act.hpp"

namespace aerogram::planner {

/// Yaw keys of a drone whose nose points where it flies, one every 200 ms or fewer where the linear way between others
/// is within 0.2 degrees; angles go on beyond ± pi, so that yaw never jumps. Where it moves less than 0.1 m/s over the
/// ground the last direction stays.
/// @param acts  without gaps.
[[nodiscard]] std::vector<YawKey> noses_forward(std::span<const Act> acts, DroneId drone);

}  // namespace aerogram::planner
