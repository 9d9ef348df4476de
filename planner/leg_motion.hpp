#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geo/result.hpp"
#include "geo/run.hpp"
#include "planner/leg.hpp"
#include "planner/motion/timing.hpp"

namespace aerogram::planner {

/// How a leg's motion came about, for certificate and report.
struct LegReport {
    std::string method;          ///< what is flown; "auto: rigid" when the planner chose
    std::string chosen_because;  ///< auto's reason: every candidate with its figures
    std::string separation_by;   ///< the rungs taken, in order; empty: nothing was needed
    int separation_rounds = 0;
    std::size_t swapped = 0;  ///< drones that took each other's targets
    double path_ratio = 1.0;
    double required_separation_m = 0.0;
};

/// A leg's geometry, separated, and the shortest time in which it can be flown.
struct LegMotion {
    Motion motion;
    ShortestDuration shortest;
    std::optional<double> wanted_s;           ///< the designer's duration
    bool fixed = false;                       ///< flown in wanted_s and no other time: its geometry depends on it
    std::vector<std::size_t> keyframe_knots;  ///< flows: knots at which keyframes first..last are met
    std::vector<std::uint32_t> target_of;     ///< drones that took each other's targets; empty: nobody did
    LegReport report;
};

/// Transition, then separation (DESIGN.md 7, 8): straight flights that are safe stay as they are; else the ladder of
/// planner/separation, every rung reported. `auto` plans every candidate so and keeps the best (auto_choice.hpp). What
/// could not be separated is returned as it is: the certificate names pair, time and distance. Errors: invalid_input at
/// a mission line; stopped.
Result<LegMotion> plan_leg(const Mission& mission, const Route& route, const Leg& leg, const Run& run);

/// The same by one method: straight, spectral, rigid or steered, whatever the leg says.
Result<LegMotion> plan_leg_by(const Mission& mission, const Route& route, const Leg& leg, Method method,
                              const Run& run);

[[nodiscard]] const char* name_of(Method method);

}  // namespace aerogram::planner
