#include <cmath>
#include <nlohmann/json.hpp>

#include "export/bytes/decimal.hpp"
#include "export/bytes/files.hpp"
#include "export/waypoint/mission_items.hpp"
#include "export/waypoint/qgc_plan.hpp"

namespace aerogram::exporter {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kArduPilot = 3, kPx4 = 12;
constexpr int kMultirotor = 2;

double rounded(double value, int digits) {
    return static_cast<double>(in_units(value, digits)) / std::pow(10.0, digits);
}

double degrees_of(double value_deg) {
    return rounded(value_deg, 8);
}

/// A parameter: a whole number where it is one.
Json number(double value) {
    if (value == std::floor(value)) return static_cast<std::int64_t>(value);
    return rounded(value, 3);
}

/// PX4 turns to p4 (null: as it likes); ArduPilot does not look at it and refuses null in places.
Json simple_item(const MissionItem& item, std::size_t place, bool px4) {
    constexpr std::size_t kYaw = 3, kLatitude = 4, kLongitude = 5, kAltitude = 6;
    Json params = Json::array();
    for (std::size_t k = 0; k < kLatitude; ++k) params.push_back(number(item.params[k]));
    if (px4 && item.frame != mav::kMission) params[kYaw] = nullptr;
    if (item.frame == mav::kMission) {
        for (std::size_t k = kLatitude; k < item.params.size(); ++k) params.push_back(number(item.params[k]));
    } else {
        params.push_back(degrees_of(item.params[kLatitude]));
        params.push_back(degrees_of(item.params[kLongitude]));
        params.push_back(rounded(item.params[kAltitude], 3));
    }
    return {{"type", "SimpleItem"},        {"frame", item.frame},  {"command", item.command},
            {"params", std::move(params)}, {"autoContinue", true}, {"doJumpId", place}};
}

Json mission_of(const OutgoingFacts& facts, const FleetMissions& fleet, const DroneMission& drone) {
    Json items = Json::array();
    for (const MissionItem& item : mission_items(fleet, drone))
        items.push_back(simple_item(item, items.size() + 1, fleet.px4));
    const Json home = {degrees_of(drone.home.latitude_deg), degrees_of(drone.home.longitude_deg),
                       rounded(drone.home_amsl_m, 3)};
    return {{"version", 2},
            {"firmwareType", fleet.px4 ? kPx4 : kArduPilot},
            {"vehicleType", kMultirotor},
            {"cruiseSpeed", facts.limits.speed_horizontal_mps},
            {"hoverSpeed", facts.limits.speed_horizontal_mps},
            {"plannedHomePosition", home},
            {"items", std::move(items)}};
}

Json polygon(const geo::ShowFrame& frame, const geo::Polygon& outline_m, bool inclusion) {
    Json corners = Json::array();
    for (const Vec2& p : outline_m) {
        const geo::Geodetic corner = frame.to_geodetic({p.x, p.y, 0.0});
        corners.push_back({degrees_of(corner.latitude_deg), degrees_of(corner.longitude_deg)});
    }
    return {{"version", 1}, {"inclusion", inclusion}, {"polygon", std::move(corners)}};
}

Json fence_of(const OutgoingFacts& facts) {
    const geo::ShowFrame frame(*facts.origin);
    Json polygons = Json::array();
    if (!facts.airspace.geofence_m.empty()) polygons.push_back(polygon(frame, facts.airspace.geofence_m, true));
    for (const geo::Polygon& audience : facts.airspace.audience_m) polygons.push_back(polygon(frame, audience, false));
    return {{"version", 2}, {"polygons", std::move(polygons)}, {"circles", Json::array()}};
}

/// Home, at the altitude of the return.
Json rally_of(const DroneMission& drone) {
    const double altitude_m = drone.items[drone.items.size() - 2].altitude_above_home_m;
    const Json point = {degrees_of(drone.home.latitude_deg), degrees_of(drone.home.longitude_deg),
                        rounded(altitude_m, 3)};
    return {{"version", 2}, {"points", Json::array({point})}};
}

Json model_of(const FleetMissions& fleet, const planner::ExportWishes& wishes) {
    return {{"speedMps", fleet.model.speed_mps},          {"speedUpMps", fleet.model.speed_up_mps},
            {"speedDownMps", fleet.model.speed_down_mps}, {"accelerationMps2", fleet.model.acceleration_mps2},
            {"jerkMps3", fleet.model.jerk_mps3},          {"slackS", wishes.slack_s}};
}

Json own_words(const OutgoingFacts& facts, const Seal& seal, const FleetMissions& fleet, const DroneMission& drone) {
    Json words{{"title", facts.title},
               {"drone", drone.name},
               {"showHash", seal.show_hash},
               {"certified", seal.certified},
               {"timing", timing_words(fleet.timing) + ": separation is not claimed"}};
    if (fleet.departures) {
        const Departures& when = *fleet.departures;
        words["startUtc"] = utc_text(when.start_utc_s);
        words["startMissionsFrom"] = utc_text(when.first_start_utc_s);
        words["startMissionsUntil"] = utc_text(when.last_start_utc_s);
        words["legs"] = model_of(fleet, facts.exporting);
    }
    return words;
}

Result<std::vector<std::string>> write(const OutgoingShow& show, const Seal& seal, const std::filesystem::path& folder,
                                       const Run& run) {
    const auto fleet = fleet_missions(show);
    if (!fleet) return Error{fleet.error().code, "qgc: " + fleet.error().message};
    const OutgoingFacts& facts = show.facts();
    const Json fence = fence_of(facts);
    return write_missions(*fleet, "qgc", ".plan", folder, run, [&](const DroneMission& drone) {
        const Json root{{"fileType", "Plan"},
                        {"groundStation", "Aerogram"},
                        {"version", 1},
                        {"mission", mission_of(facts, *fleet, drone)},
                        {"geoFence", fence},
                        {"rallyPoints", rally_of(drone)},
                        {"aerogram", own_words(facts, seal, *fleet, drone)}};
        return root.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
    });
}

bool recognises(std::string_view path, std::string_view first_bytes) {
    const bool brace = first_bytes.substr(0, 16).find('{') != std::string_view::npos;
    const bool plan = first_bytes.find("\"fileType\"") != std::string_view::npos;
    return brace && (path.ends_with(".plan") || plan);
}

constexpr Format kQgcPlan{
    "qgc",      "QGroundControl plans, one a drone: keyframe places (timing none, absolute or speed), fence, rally",
    "none",     "curves, lights, yaw, events, cues, limits; of times all but the waits of timing absolute",
    write,      read_qgc_plan,
    recognises, unsuited_for_missions,
    true};

}  // namespace

const Format& qgc_plan_format() {
    return kQgcPlan;
}

}  // namespace aerogram::exporter
