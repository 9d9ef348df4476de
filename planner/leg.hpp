#pragma once
#include <optional>
#include <string>
#include <vector>

#include "geo/result.hpp"
#include "geo/run.hpp"
#include "planner/mission/mission.hpp"
#include "planner/motion/timing.hpp"
#include "planner/route.hpp"

namespace aerogram::planner {

/// One movement between two places where the fleet stands: take-off, an arrival (a flow arrives through several
/// keyframes), the return, the landing.
struct Leg {
    std::string name;
    ActRole role = ActRole::transit;
    Arrive how;                       ///< of the last keyframe reached; defaults for take-off, return and landing
    std::size_t first = 0, last = 0;  ///< keyframes reached, for arrivals
    bool arrives = false;             ///< false: take-off, return, landing
    Points from_m, to_m;              ///< by drone
    bool pairwise = true;             ///< of the matching flown
    std::string assignment;
};

/// The legs of a route in flying order.
std::vector<Leg> legs_of(const Mission& mission, const Route& route);

/// How a leg's motion came about, for certificate and report.
struct LegReport {
    std::string method, separation_by;
    int separation_rounds = 0;
    double path_ratio = 1.0;
};

/// A leg's geometry, separated, and the shortest time in which it can be flown.
struct LegMotion {
    Motion motion;
    ShortestDuration shortest;
    std::optional<double> wanted_s;           ///< the designer's duration
    std::vector<std::size_t> keyframe_knots;  ///< flows: knots at which keyframes first..last are met
    LegReport report;
};

/// Transition, then separation (DESIGN.md 7, 8): straight flights that are safe stay as they are; else the projection,
/// then a finer lattice with a wider filter, then, for freely matched keyframes, straight lines; every rung taken is
/// reported. What could not be separated is returned as it is: the certificate names pair, time and distance. Errors:
/// stopped.
Result<LegMotion> plan_leg(const Mission& mission, const Route& route, const Leg& leg, const Run& run);

}  // namespace aerogram::planner
