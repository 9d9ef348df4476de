#pragma once
#include <string>

#include "planner/motion/flight_plan.hpp"

namespace aerogram::exporter {

/// The one hash of a show: SHA-256 of the payload of its trajectories.bin, that is of geometry and clock, pads, origin,
/// heading, fence, audience, obstacles, limits, lights, yaw, events and cues. Equal hash: the same show.
std::string show_hash(const planner::FlightPlan& plan);

}  // namespace aerogram::exporter
