#pragma once
#include <string>
#include <vector>

#include "geo/result.hpp"
#include "geo/run.hpp"
#include "planner/mission/mission.hpp"
#include "planner/motion/flight_plan.hpp"
#include "planner/takeoff.hpp"

namespace aerogram::planner {

/// One place where the fleet stands (or, in a flow, passes): a keyframe's slots, matched to drones.
struct Stop {
    PlannedKeyframe keyframe;  ///< times are still 0
    Points by_drone_m;         ///< by drone, on arrival: formation_m[slot_of[d]]
    std::vector<bool> still;   ///< by drone: waits above a pad and takes no part in the keyframe's own motion
    Points left_from_m;        ///< by drone, after the keyframe's own motion
    std::string assignment;    ///< how drones were matched, for people
    bool pairwise = false;     ///< no two straight flights towards here cross (assignment.hpp)
};

/// Formations and who flies where, keyframe after keyframe.
struct Route {
    PadLayers layers;           ///< where take-off ends and landing begins
    std::vector<Stop> stops;    ///< one a keyframe
    std::vector<Group> groups;  ///< the mission's, clusters filled
};

/// Builds every keyframe's formation, matches the fleet to each in turn, and finds the groups that the mission asks for
/// by clustering the first keyframe.
/// Errors: invalid_input at a mission line; infeasible when groups, pins or forbidden pairs admit no matching; stopped.
Result<Route> build_route(const Mission& mission, const Run& run);

}  // namespace aerogram::planner
