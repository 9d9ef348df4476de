#pragma once
#include <string>
#include <vector>

#include "planner/mission/mission.hpp"
#include "planner/motion/act.hpp"
#include "planner/route.hpp"

namespace aerogram::planner {

/// One movement between two places where the fleet stands: a wave of take-off, an arrival (a flow arrives through
/// several keyframes), the return, a wave of landing.
struct Leg {
    std::string name;
    ActRole role = ActRole::transit;
    Arrive how;                       ///< of the last keyframe reached; defaults for take-off, return and landing
    std::size_t first = 0, last = 0;  ///< keyframes reached, for arrivals
    bool arrives = false;             ///< false: take-off, return, landing
    Points from_m, to_m;              ///< by drone
    bool pairwise = true;             ///< of the matching flown
    bool may_swap = false;            ///< drones may take each other's targets: from here on nobody's name matters
    std::string assignment;
};

/// The legs of a route in flying order.
std::vector<Leg> legs_of(const Mission& mission, const Route& route);

/// What two drones keep between them on a leg: the planned separation, or more where the mission asks for it.
[[nodiscard]] double required_separation_m(const Mission& mission, const Leg& leg);

}  // namespace aerogram::planner
