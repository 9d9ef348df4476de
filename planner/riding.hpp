#pragma once
#include <vector>

#include "geo/result.hpp"
#include "geo/run.hpp"
#include "planner/leg_motion.hpp"
#include "planner/mission/mission.hpp"
#include "planner/timeline.hpp"

namespace aerogram::planner {

/// A show on its clock: what is flown, and the legs (with how they came about) that its acts point to.
struct Flown {
    std::vector<Leg> legs;
    std::vector<LegReport> reports;  ///< one a leg
    Timeline timeline;
    std::vector<Group> groups{};  ///< the mission's, clusters filled
};

/// Plans a show that rides along its carrier's route: everything up to the last formation as if the carrier stood at
/// the start of the route, then the ride (planner/carrier), lengthening flights until the ground-fixed motion holds
/// every limit; copters then return from where the ride ended. Planes have no take-off and no landing: they begin in
/// the first formation at the start of the route, and the show ends with the last one.
/// @param mission  with a carrier.
/// Errors: as build_route, plan_leg, build_timeline and ride; infeasible when no lengthening helps.
Result<Flown> plan_riding(const Mission& mission, const Run& run);

}  // namespace aerogram::planner
