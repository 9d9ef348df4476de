#pragma once
#include <vector>

#include "export/record/recorded_show.hpp"
#include "geo/result.hpp"
#include "geo/run.hpp"

/// When and where a whole fleet stands: the formations of a show that was read from a file.
namespace aerogram::exporter {

/// A span of time in which nobody moves.
struct Stand {
    Millis from_ms = 0, to_ms = 0;
    Points places_m;     ///< one a drone, in the middle of the span
    bool aloft = false;  ///< not over the pads before the fleet leaves them, or after it has come back
};

inline constexpr Millis kShortestStand_ms = 500;

/// What a drone that stands may seem to move by: twice what rounding (and, of lines in time, the fit) may miss, and
/// 1 mm.
[[nodiscard]] double standing_tolerance_m(const Rounding& rounding);

/// Every span of at least kShortestStand_ms in which each drone stays within standing_tolerance_m of one place, in time
/// order; longer where the tolerance is above 25 mm: nobody stands who creeps through it at 0.05 m/s. Of spans within a
/// second and 0.3 m of each other, as slow arrivals make them, the longest counts.
/// @param show  timed and well-formed, at least one drone.
/// Properties: (1) at every instant of a span every drone is within the tolerance of its place (2) a span in which the
/// fleet really stands, as long as that, overlaps one that is found (3) neither the order of drones nor
/// threads change times. Errors: stopped. Cost: linear in the pieces; spans are found to 10 ms.
Result<std::vector<Stand>> stands(const RecordedShow& show, const Run& run);

}  // namespace aerogram::exporter
