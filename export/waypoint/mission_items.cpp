#include "export/waypoint/mission_items.hpp"

#include <algorithm>
#include <cmath>

#include "export/bytes/files.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

using planner::Autopilot, planner::WaypointTiming;

/// Autopilots know no slower speed than this.
constexpr double kSlowest_mps = 0.2;
/// Legs that go less far over the ground are climbs and descents.
constexpr double kOverGround_m = 0.1;

double hold_s(const Stops& stops, std::size_t k) {
    return std::max(kShortestHold_s, std::round(seconds_from_ms(stops.to_ms[k] - stops.from_ms[k])));
}

/// Over the ground, so that the leg to stop k takes the plan's time; absent for climbs and descents.
std::optional<double> ground_speed_mps(const FleetMissions& fleet, const Stops& stops, const Points& places,
                                       std::size_t k) {
    const Vec3 way_m = places[k] - places[k - 1];
    const double over_ground_m = std::hypot(way_m.x, way_m.y);
    if (over_ground_m < kOverGround_m) return std::nullopt;
    const double held_s = k == 1 ? 0.0 : hold_s(stops, k - 1);
    const double takes_s = seconds_from_ms(stops.from_ms[k] - stops.from_ms[k - 1]) - held_s;
    const double speed_mps = speed_for_s(fleet.model, way_m, takes_s);
    return std::max(kSlowest_mps, speed_mps * over_ground_m / glm::length(way_m));
}

MissionItem speed_item(int kind, double speed_mps) {
    return {mav::kMission, mav::kChangeSpeed, {static_cast<double>(kind), speed_mps, -1.0, 0.0, 0.0, 0.0, 0.0}};
}

/// Waits for a UTC time of day; the next day's where it has passed.
MissionItem wait_item(UtcSeconds utc_s) {
    constexpr UtcSeconds kDay_s = 86'400;
    const auto second = static_cast<int>(utc_s % kDay_s);
    return {
        mav::kMission, mav::kDelay, {-1.0, second / 3600 * 1.0, second / 60 % 60 * 1.0, second % 60 * 1.0, 0, 0, 0}};
}

int command_of(Waypoint::Kind kind) {
    if (kind == Waypoint::Kind::takeoff) return mav::kTakeoff;
    return kind == Waypoint::Kind::land ? mav::kLand : mav::kWaypoint;
}

DroneMission mission_of(const OutgoingFacts& facts, const FleetMissions& fleet, const Stops& stops, std::size_t i,
                        const geo::ShowFrame& frame) {
    const Vec3& pad = facts.drones[i].home_m;
    const Points& places = stops.places_m[i];
    DroneMission mission{facts.drones[i].name, frame.to_geodetic(pad), 0.0, {}};
    const auto add = [&](const Vec3& place, double seconds, Waypoint::Kind kind) -> Waypoint& {
        mission.items.push_back({frame.to_geodetic(place), frame.altitude_above(pad, place), seconds, kind, {}, {}});
        return mission.items.back();
    };
    for (std::size_t k = 0; k < stops.count(); ++k) {
        const bool waits = fleet.timing == WaypointTiming::absolute;
        const double held_s = k == 0 ? 0.0 : waits ? kShortestHold_s : hold_s(stops, k);
        Waypoint& stop = add(places[k], held_s, k == 0 ? Waypoint::Kind::takeoff : Waypoint::Kind::fly_to);
        if (waits) stop.until_s = static_cast<double>(fleet.departures->leave_s[k]);
        if (fleet.timing == WaypointTiming::speed && k > 0) stop.speed_mps = ground_speed_mps(fleet, stops, places, k);
    }
    add(facts.drones[i].land_m, 0.0, Waypoint::Kind::land);
    return mission;
}

/// What can be said before any flight is looked at.
std::string unsuited_facts(const OutgoingFacts& facts) {
    if (!facts.origin) return "its place on the globe is not known";
    if (!facts.origin->geoid_undulation_m)
        return "planned homes are above mean sea level: the mission needs geoid_undulation_m";
    if (facts.limits.plane) return "planes: they would take off upright and stop at every waypoint";
    if (facts.rides) return "a show that rides along a route: its formations do not stand where a waypoint could be";
    const std::size_t items = item_count(facts);
    if (items > facts.exporting.mission_items)
        return std::to_string(items) + " mission items a drone, home included; mission_items = " +
               std::to_string(facts.exporting.mission_items) +
               " (boards hold: 4 KB 161, 8 to 15 KB 303, 16 KB 650, 32 KB 1306)";
    if (facts.exporting.timing != WaypointTiming::absolute) return {};
    if (facts.exporting.autopilot == Autopilot::px4)
        return "timing = absolute: PX4 waits for a number of seconds, not for a time of day; only ArduPilot does";
    if (!facts.exporting.start_utc_s) return "timing = absolute needs start_utc or --start-utc";
    return {};
}

}  // namespace

std::size_t item_count(const OutgoingFacts& facts) {
    const bool px4 = facts.exporting.autopilot == Autopilot::px4;
    const std::size_t stops = facts.keyframes.size() + 2, nobody_home = px4 ? 0 : 1, land = 1, speeds = 3;
    switch (facts.exporting.timing) {
        case WaypointTiming::absolute:
            return nobody_home + 2 * stops + speeds + land;
        case WaypointTiming::speed:
            return nobody_home + 2 * stops - 1 + land;
        case WaypointTiming::none:
            break;
    }
    return nobody_home + stops + land;
}

std::string unsuited_for_missions(const OutgoingShow& show) {
    const OutgoingFacts& facts = show.facts();
    if (std::string why = unsuited_facts(facts); !why.empty()) return why;
    if (facts.exporting.timing != WaypointTiming::absolute) return {};
    const auto found = departures(facts, stops_of(show));
    return found ? std::string() : found.error().message;
}

Result<FleetMissions> fleet_missions(const OutgoingShow& show) {
    const OutgoingFacts& facts = show.facts();
    if (std::string why = unsuited_facts(facts); !why.empty()) return Error{ErrorCode::invalid_input, why};
    const Stops stops = stops_of(show);
    FleetMissions fleet;
    fleet.timing = facts.exporting.timing;
    fleet.px4 = facts.exporting.autopilot == Autopilot::px4;
    fleet.model = leg_model(facts.exporting, facts.limits);
    if (fleet.timing == WaypointTiming::absolute) {
        auto found = departures(facts, stops);
        if (!found) return found.error();
        fleet.departures = std::move(*found);
    }
    const geo::ShowFrame frame(*facts.origin);
    for (std::size_t i = 0; i < show.drones(); ++i) {
        fleet.drones.push_back(mission_of(facts, fleet, stops, i, frame));
        const auto home_amsl_m = frame.amsl_m(facts.drones[i].home_m);
        if (!home_amsl_m) return home_amsl_m.error();
        fleet.drones.back().home_amsl_m = *home_amsl_m;
    }
    return fleet;
}

std::vector<MissionItem> mission_items(const FleetMissions& fleet, const DroneMission& drone) {
    constexpr int kOverGround = 1, kClimb = 2, kDescent = 3;
    std::vector<MissionItem> items;
    for (const Waypoint& stop : drone.items) {
        if (stop.speed_mps) items.push_back(speed_item(kOverGround, *stop.speed_mps));
        items.push_back({mav::kGlobalRelative,
                         command_of(stop.kind),
                         {stop.hold_s, 0.0, 0.0, 0.0, stop.place.latitude_deg, stop.place.longitude_deg,
                          stop.altitude_above_home_m}});
        if (stop.kind == Waypoint::Kind::takeoff && fleet.departures) {
            items.push_back(speed_item(kOverGround, fleet.model.speed_mps));
            items.push_back(speed_item(kClimb, fleet.model.speed_up_mps));
            items.push_back(speed_item(kDescent, fleet.model.speed_down_mps));
        }
        if (stop.until_s)
            items.push_back(wait_item(fleet.departures->start_utc_s + static_cast<UtcSeconds>(*stop.until_s)));
    }
    return items;
}

std::string timing_words(WaypointTiming timing) {
    if (timing == WaypointTiming::none) return "none";
    return std::string(timing == WaypointTiming::absolute ? kAbsoluteTiming : kSpeedTiming);
}

Result<std::vector<std::string>> write_missions(const FleetMissions& fleet, const std::string& name,
                                                std::string_view ending, const std::filesystem::path& folder,
                                                const Run& run,
                                                const std::function<std::string(const DroneMission&)>& text_of) {
    std::vector<std::string> files(fleet.drones.size());
    std::vector<Status> written(files.size(), Done{});
    parallel_for(files.size(), run, name, [&](std::size_t i) {
        const DroneMission& drone = fleet.drones[i];
        files[i] = name + "/" + drone.name + std::string(ending);
        written[i] = write_file(folder / files[i], text_of(drone));
    });
    if (run.stopped()) return stopped_error();
    const auto failed = std::ranges::find_if(written, [](const Status& status) { return !status.ok(); });
    if (failed != written.end()) return failed->error();
    return files;
}

Rounding mission_rounding() {
    Rounding rounding;
    rounding.position_m = 0.0008;  // half of 1e-8 degrees north and east, along an axis between them
    rounding.has_speed = false;
    rounding.has_acceleration = false;
    return rounding;
}

}  // namespace aerogram::exporter
