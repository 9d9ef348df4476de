#pragma once
#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "export/outgoing/outgoing_show.hpp"
#include "export/record/recorded_show.hpp"
#include "export/waypoint/departures.hpp"
#include "geo/run.hpp"

/// A show as waypoint missions. Shared by the formats that ground stations load (FORMATS.md 5, docs/formats/
/// waypoints.md).
namespace aerogram::exporter {

/// MAVLink commands and frames that are written and read.
namespace mav {
inline constexpr int kWaypoint = 16, kLoiterTime = 19, kReturn = 20, kLand = 21, kTakeoff = 22, kSpline = 82,
                     kDelay = 93, kChangeSpeed = 178;
inline constexpr int kGlobal = 0, kMission = 2, kGlobalRelative = 3, kGlobalInt = 5, kGlobalRelativeInt = 6;
}  // namespace mav

/// RecordedShow::timing of missions that wait for times, and of those that only set speeds.
inline constexpr std::string_view kAbsoluteTiming = "absolute";
inline constexpr std::string_view kSpeedTiming = "speed: legs 0.5 to 5 s late, vehicles up to 4 s apart";

/// One drone's mission. Altitudes are above its own home: differences of ellipsoidal heights (geo::ShowFrame).
struct DroneMission {
    std::string name;
    geo::Geodetic home;
    double home_amsl_m = 0.0;
    std::vector<Waypoint> items;  ///< take-off, keyframe places with their holds, return above the pad, land
};
struct FleetMissions {
    planner::WaypointTiming timing = planner::WaypointTiming::none;
    bool px4 = false;
    LegModel model;
    std::optional<Departures> departures;  ///< of absolute missions
    std::vector<DroneMission> drones;
};

/// Why a show cannot leave as waypoints, or empty: no geoid undulation (planned homes are AMSL), more items than the
/// board holds, PX4 asked to wait for a time, or no proof that every vehicle comes in time (departures.hpp).
[[nodiscard]] std::string unsuited_for_missions(const OutgoingShow& show);
/// The missions of all drones. @param show  suited. Errors: invalid_input with the reason when it is not.
/// Keyframes are met at the drone's slot. Timing none and speed: held for their standing time in whole seconds, at
/// least 1 (of speed missions each leg flies at the speed that takes the plan's time); absolute: held for 1 s, then
/// left at departures().
Result<FleetMissions> fleet_missions(const OutgoingShow& show);

/// A mission item as a file tells it.
struct MissionItem {
    int frame = 0, command = 0;
    std::array<double, 7> params{};  ///< p1..p4, latitude, longitude, altitude
};
/// What is written of a drone, home excluded: take-off first (a wait before it would end in disarming), then, of
/// absolute missions, the three speeds of the model; a wait behind each waypoint, or a speed before it.
[[nodiscard]] std::vector<MissionItem> mission_items(const FleetMissions& fleet, const DroneMission& drone);
/// How many items a drone's mission has, home included (PX4 has none).
[[nodiscard]] std::size_t item_count(const OutgoingFacts& facts);

/// "none", or as RecordedShow::timing says it.
[[nodiscard]] std::string timing_words(planner::WaypointTiming timing);
/// Writes FOLDER/NAME/drone-001ENDING and so on, from several threads. Errors: io; stopped.
Result<std::vector<std::string>> write_missions(const FleetMissions& fleet, const std::string& name,
                                                std::string_view ending, const std::filesystem::path& folder,
                                                const Run& run,
                                                const std::function<std::string(const DroneMission&)>& text_of);

/// What the waypoint formats state: eight decimals of a degree, millimetres of altitude; no times, so no speeds.
[[nodiscard]] Rounding mission_rounding();

}  // namespace aerogram::exporter
