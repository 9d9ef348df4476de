#pragma once
#include <vector>

#include "geo/result.hpp"
#include "planner/leg_motion.hpp"
#include "planner/mission/mission.hpp"
#include "planner/motion/flight_plan.hpp"

namespace aerogram::planner {

/// Acts on one clock, and for each the leg it flies (absent for holds).
struct Timeline {
    std::vector<Act> acts;
    std::vector<std::optional<std::size_t>> leg_of;
    std::vector<PlannedKeyframe> keyframes;  ///< with their standing times
};

/// Puts legs and holds one after another, holds moving where their keyframe does: each leg in its shortest time or the
/// designer's longer one; a keyframe with at_s is reached then, by flying slower or, where the duration is given too,
/// by holding the formation before longer. Errors: invalid_input when a duration, an at_s or a moving hold is too
/// short, naming the shortest possible.
Result<Timeline> build_timeline(const Mission& mission, const Route& route, const std::vector<Leg>& legs,
                                std::vector<LegMotion> motions);

/// Lamps: dark on the ground, each slot's colour while its formation stands, fading on the way. No yaw keys: noses
/// along show +y.
std::vector<Tracks> build_tracks(const std::vector<PlannedKeyframe>& keyframes, const std::vector<Act>& acts,
                                 std::size_t drones);

}  // namespace aerogram::planner
