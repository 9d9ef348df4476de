#pragma once
#include "export/verify/rules.hpp"

namespace aerogram::exporter {

/// The legs of an untimed show as straight lines in the show frame, one pseudo-second each, so that places can be
/// judged like those of a timed one: vertical take-off above home, straight to each waypoint, level to the landing
/// place and straight down. Without an origin in `rules`, the first drone's home becomes one (heading north). Errors:
/// invalid_input naming the drone that has no home, or a place that is not on earth.
Result<RecordedShow> legs_as_pieces(const RecordedShow& untimed, Rules& rules);

}  // namespace aerogram::exporter
