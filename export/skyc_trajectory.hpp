#pragma once
#include <string>
#include <vector>

#include "export/curve_fit.hpp"
#include "geo/run.hpp"
#include "planner/motion/flight_plan.hpp"

namespace aerogram::exporter {

/// trajectory.json of every drone: the plan's acts refitted (export/curve_fit.hpp), rounded to millimetres, X front.
/// Errors: infeasible naming drone, act and misfit when a curve cannot be held within kFitBound; stopped.
Result<std::vector<std::string>> skyc_trajectories(const planner::FlightPlan& plan, const Run& run);

}  // namespace aerogram::exporter
