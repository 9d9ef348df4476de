#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "export/curve_fit.hpp"
#include "geo/run.hpp"
#include "planner/motion/flight_plan.hpp"

namespace aerogram::exporter {

/// Why a plan's curves cannot be written, or empty: the first drone whose half-second cubics are not within fit_bound.
[[nodiscard]] std::string skyc_misfit(const planner::FlightPlan& plan);

/// trajectory.json of the drones from `first` to before `end`: the plan's acts refitted (export/curve_fit.hpp), rounded
/// to millimetres, X front. Errors: infeasible naming drone, act and misfit when a curve cannot be held within
/// fit_bound; stopped.
Result<std::vector<std::string>> skyc_trajectories(const planner::FlightPlan& plan, std::size_t first, std::size_t end,
                                                   const Run& run);

}  // namespace aerogram::exporter
