#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "export/outgoing/outgoing_show.hpp"
#include "export/waypoint/leg_time.hpp"
#include "geo/utc.hpp"

/// When vehicles leave their waypoints together, and the proof that none arrives too late to do so: a vehicle that
/// comes after the moment it waits for waits until the same time of the next day.
namespace aerogram::exporter {

/// Where the fleet stops: above the pads, at every keyframe, above the pads again.
struct Stops {
    std::vector<std::string> names;      ///< "take-off", the keyframes', "return"
    std::vector<Millis> from_ms, to_ms;  ///< when the plan stands there
    std::vector<double> drifts_m;        ///< how far a drone is from its place when the plan leaves: 0 where it stands
    std::vector<Points> places_m;        ///< [drone][stop], show frame
    [[nodiscard]] std::size_t count() const { return names.size(); }
};
/// Take-off ends where the take-off acts do (at the minimum navigation altitude when there are none), the return is
/// where the landing acts begin (likewise). Memory: 24 bytes a drone and stop.
[[nodiscard]] Stops stops_of(const OutgoingShow& show);

/// Show times of the fleet, whole seconds since start_utc_s.
struct Departures {
    UtcSeconds start_utc_s = 0;
    std::vector<std::int64_t> leave_s;  ///< one a stop, rising
    /// Missions are started in this window: the last vehicle hovers slack_s before leave_s[0], the first does so for
    /// kStartWindow_s longer.
    UtcSeconds first_start_utc_s = 0, last_start_utc_s = 0;
};
inline constexpr std::int64_t kStartWindow_s = 30;

/// The moments of `timing = "absolute"`. All leave a stop at the whole second nearest to the plan's moment (halves
/// later); the return, which no keyframe waits for, is left at the plan's moment or as much later as the slowest needs.
/// A flow's keyframe becomes a stop like any other, if there is time.
/// Properties: (1) from leaving one stop, every drone needs at most (leave_s[k] - leave_s[k - 1]) - slack_s by
/// leg_needs_s until it may leave the next (2) one second less at any refused leg's stop is refused too.
/// Errors: invalid_input when there is no start, the show takes longer than twelve hours or, with the later return,
/// than the endurance, pads are closer than the minimum separation (all climb at once), a formation moves while it
/// stands, or a leg has too little time: names the leg with the least slack, its drone, what it needs, what is there,
/// and what would do.
Result<Departures> departures(const OutgoingFacts& facts, const Stops& stops);

}  // namespace aerogram::exporter
