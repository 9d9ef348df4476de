#pragma once
#include "geo/result.hpp"
#include "geo/run.hpp"
#include "planner/mission/mission.hpp"
#include "planner/motion/flight_plan.hpp"

namespace aerogram::planner {

struct PlanOptions {
    bool best_effort = false;  ///< return the plan even when it could not be certified; its certificate says so
};

/// Plans a mission: formations, who flies where, transitions, separation, timing, certificate (DESIGN.md 1).
/// Properties: (1) same mission, same plan, whatever run.threads (2) every act's certificate holds, or the call fails
/// (best_effort excepted).
/// Errors: invalid_input at a mission line; infeasible naming act, pair, time and distance or the limit and what would
/// do; stopped.
Result<FlightPlan> plan(const Mission& mission, const PlanOptions& options, const Run& run);

/// Why a plan that is not certified cannot be flown: what `plan` says when it fails for that.
[[nodiscard]] Error refusal(const Mission& mission, const Certificate& certificate);

}  // namespace aerogram::planner
