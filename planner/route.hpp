#pragma once
#include <string>
#include <vector>

#include "geo/result.hpp"
#include "geo/run.hpp"
#include "planner/mission/mission.hpp"
#include "planner/motion/flight_plan.hpp"

namespace aerogram::planner {

/// One place where the fleet stands (or, in a flow, passes): a keyframe's slots, matched to drones.
struct Stop {
    PlannedKeyframe keyframe;  ///< times are still 0
    Points by_drone_m;         ///< by drone: formation_m[slot_of[d]]
    std::string assignment;    ///< how drones were matched, for people
    bool pairwise = false;     ///< no two straight flights towards here cross (assignment.hpp)
};

/// Formations and who flies where, keyframe after keyframe.
struct Route {
    Points lifted_m;          ///< by drone, above the own pad: where take-off ends and landing begins
    std::vector<Stop> stops;  ///< one a keyframe
};

/// Builds every keyframe's formation and matches the fleet to each in turn.
/// Errors: invalid_input at a mission line; infeasible when groups or pins admit no matching; stopped.
Result<Route> build_route(const Mission& mission, const Run& run);

}  // namespace aerogram::planner
