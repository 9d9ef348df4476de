#pragma once
#include <span>
#include <string_view>

#include "geo/ids.hpp"
#include "geo/result.hpp"
#include "geo/run.hpp"
#include "planner/motion/flight_plan.hpp"

namespace aerogram::planner {

/// A drone that cannot fly, and the pad on which another stands that flies its part.
struct Replacement {
    DroneId drone;
    PadId pad;
    bool operator==(const Replacement&) const = default;
};

/// "17=pad 41" or "17=41": drone 17's part is flown from pad 41. Errors: invalid_input saying what would be accepted.
Result<Replacement> parse_replacement(std::string_view text);

/// The plan with some parts flown from spare pads (FlightPlan::spare_pads_m, numbered on from the last drone's),
/// without planning anything again. The way of such a drone is shifted by the difference of the pads until the first
/// transit begins, the shift fades over that act with its own profile, and grows back over the last transit; between
/// them nothing changes, and of other drones nothing at all. The drone keeps its number, name and lights. Properties:
/// (1) every other drone's control points, and all times, are the same bits (2) the drone takes off from and lands on
/// the new pad, and flies the same path between the first and the last transit (3) the acts that changed hold every
/// limit, certified anew. Errors: invalid_input: a drone or a pad that there is not, a pad or a drone named twice, a
/// pad that is some drone's home, a show without take-off, transits and landing or on a moving carrier; infeasible:
/// limit, drones and time that the new way breaks, and which other spare pads would do; stopped.
Result<FlightPlan> replaced(FlightPlan plan, std::span<const Replacement> replacements, const Run& run);

}  // namespace aerogram::planner
