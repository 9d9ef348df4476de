#pragma once
#include "export/verify/rules.hpp"

namespace aerogram::exporter {

/// The legs of an untimed show as straight lines in the show frame, one pseudo-second each, so that places can be
/// judged like those of a timed one: vertical take-off above home, straight to each waypoint, level to the landing
/// place and straight down. Without an origin in `rules`, the first drone's home becomes one (heading north). Errors:
/// invalid_input naming the drone that has no home, a place that is not on earth, or
/// one more than 100 km from home.
/// A home whose height the file does not tell stands on the show's ground.
Result<RecordedShow> legs_as_pieces(const RecordedShow& untimed, Rules& rules);

/// What can be said of a fleet whose missions wait for times: leaving_times, seconds, how far apart drones leave the
/// waypoints that they wait at (the first of one with the first of another, and so on; a wait that another lacks counts
/// as a day), limit 0; separation_standing, m, at least: between drones at the waypoints that they leave together.
/// Between those moments nothing is said. Empty for a single drone, and where a drone never waits.
/// @param legs  of legs_as_pieces.
/// Errors: stopped.
Result<std::vector<Finding>> standing_findings(const RecordedShow& untimed, const RecordedShow& legs,
                                               const Rules& rules, const Run& run);

}  // namespace aerogram::exporter
