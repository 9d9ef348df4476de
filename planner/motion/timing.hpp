#pragma once
#include <string>

#include "geo/limits.hpp"
#include "planner/motion/act.hpp"

namespace aerogram::planner {

/// The largest of each limited quantity over all drones at every instant of an act. Speeds are bounded by their control
/// polygon (0.005-0.15 % above the true peak), acceleration and jerk are exact. Altitudes are not here: see
/// certificate.hpp.
struct Extremes {
    double speed_horizontal_mps = 0.0, speed_up_mps = 0.0, speed_down_mps = 0.0;
    double acceleration_mps2 = 0.0, jerk_mps3 = 0.0;
};
/// @param duration_s  the act's length; quantities scale with its powers.
[[nodiscard]] Extremes extremes(const Motion& motion, double duration_s);

/// The shortest duration, whole milliseconds, at which the motion holds all speed, acceleration and jerk limits; closed
/// form (DESIGN.md 3). 0 for a hold or a motion that moves nobody.
struct ShortestDuration {
    Millis duration_ms = 0;
    std::string set_by;  ///< the limit that decides: "speed_up_mps", ...
};
[[nodiscard]] ShortestDuration shortest_duration(const Motion& motion, const Limits& limits);

}  // namespace aerogram::planner
