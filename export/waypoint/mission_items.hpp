#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "export/outgoing/outgoing_show.hpp"
#include "export/record/recorded_show.hpp"

/// A plan as waypoint missions: where each drone goes, one keyframe after another, not when. Shared by the formats that
/// ground stations load (FORMATS.md 5).
namespace aerogram::exporter {

/// MAVLink commands and frames that are written and read.
namespace mav {
inline constexpr int kWaypoint = 16, kLoiterTime = 19, kReturn = 20, kLand = 21, kTakeoff = 22, kSpline = 82,
                     kDelay = 93;
inline constexpr int kGlobal = 0, kGlobalRelative = 3, kGlobalInt = 5, kGlobalRelativeInt = 6;
}  // namespace mav

/// One drone's mission. Altitudes are above its own home: differences of ellipsoidal heights (geo::ShowFrame).
struct DroneMission {
    std::string name;
    geo::Geodetic home;
    double home_amsl_m = 0.0;
    std::vector<Waypoint> items;  ///< take-off, keyframe places with their holds, return above the pad, land
};

/// Whole seconds, at least one: autopilots store holds so, and meet only waypoints they stop at.
inline constexpr double kShortestHold_s = 1.0;
/// The most items, home included, that any of the known boards stores (32 KB).
inline constexpr std::size_t kMostMissionItems = 1306;

/// Why a show cannot leave as waypoints, or empty: no geoid undulation (planned homes are AMSL), too many keyframes.
[[nodiscard]] std::string unsuited_for_missions(const OutgoingShow& show);
/// The missions of all drones. @param show  suited. Errors: invalid_input with the reason when it is not.
/// Take-off climbs to where the take-off acts end (the minimum navigation altitude when there are none); keyframes are
/// met at the drone's slot and held for their standing time in whole seconds; the return is where the landing acts
/// begin.
Result<std::vector<DroneMission>> drone_missions(const OutgoingShow& show);

/// A mission item as a file tells it.
struct MissionItem {
    int frame = 0, command = 0;
    std::array<double, 7> params{};  ///< p1..p4, latitude, longitude, altitude
};
/// What an item means for a recorded drone; absent for items that move nobody (delays, DO_ and CONDITION_ commands).
/// @param home_amsl_m  what AMSL altitudes are taken from.
/// Errors: invalid_input for other navigation commands, frames that are neither AMSL nor above home, coordinates out of
/// range.
Result<std::optional<Waypoint>> waypoint_of(const MissionItem& item, const geo::Geodetic& home, double home_amsl_m);

/// What the waypoint formats state: eight decimals of a degree, millimetres of altitude; no times, so no speeds.
[[nodiscard]] Rounding mission_rounding();

}  // namespace aerogram::exporter
