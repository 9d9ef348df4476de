#include <cmath>
#include <nlohmann/json.hpp>

#include "export/bytes/decimal.hpp"
#include "export/bytes/files.hpp"
#include "export/waypoint/mission_items.hpp"
#include "export/waypoint/qgc_plan.hpp"

namespace aerogram::exporter {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kArduPilot = 3;
constexpr int kMultirotor = 2;

double rounded(double value, int digits) {
    return static_cast<double>(in_units(value, digits)) / std::pow(10.0, digits);
}

double degrees_of(double value_deg) {
    return rounded(value_deg, 8);
}

int command_of(Waypoint::Kind kind) {
    if (kind == Waypoint::Kind::takeoff) return mav::kTakeoff;
    return kind == Waypoint::Kind::land ? mav::kLand : mav::kWaypoint;
}

Json simple_item(const Waypoint& waypoint, std::size_t number) {
    const Json params = {std::llround(waypoint.hold_s),
                         0,
                         0,
                         0,
                         degrees_of(waypoint.place.latitude_deg),
                         degrees_of(waypoint.place.longitude_deg),
                         rounded(waypoint.altitude_above_home_m, 3)};
    return {{"type", "SimpleItem"}, {"frame", mav::kGlobalRelative}, {"command", command_of(waypoint.kind)},
            {"params", params},     {"autoContinue", true},          {"doJumpId", number}};
}

Json mission_of(const OutgoingFacts& facts, const DroneMission& drone) {
    Json items = Json::array();
    for (std::size_t k = 0; k < drone.items.size(); ++k) items.push_back(simple_item(drone.items[k], k + 1));
    const Json home = {degrees_of(drone.home.latitude_deg), degrees_of(drone.home.longitude_deg),
                       rounded(drone.home_amsl_m, 3)};
    return {{"version", 2},
            {"firmwareType", kArduPilot},
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

Json own_words(const OutgoingFacts& facts, const Seal& seal, const DroneMission& drone) {
    return {{"title", facts.title},
            {"drone", drone.name},
            {"showHash", seal.show_hash},
            {"certified", seal.certified},
            {"timing", "none: separation is not claimed"}};
}

Result<std::vector<std::string>> write(const OutgoingShow& show, const Seal& seal, const std::filesystem::path& folder,
                                       const Run& run) {
    const auto missions = drone_missions(show);
    if (!missions) return Error{missions.error().code, "qgc: " + missions.error().message};
    const Json fence = fence_of(show.facts());
    std::vector<std::string> files;
    for (const DroneMission& drone : *missions) {
        if (run.stopped()) return stopped_error();
        const Json root{{"fileType", "Plan"},
                        {"groundStation", "Aerogram"},
                        {"version", 1},
                        {"mission", mission_of(show.facts(), drone)},
                        {"geoFence", fence},
                        {"rallyPoints", rally_of(drone)},
                        {"aerogram", own_words(show.facts(), seal, drone)}};
        files.push_back("qgc/" + drone.name + ".plan");
        const std::string text = root.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
        if (const Status written = write_file(folder / files.back(), text); !written) return written.error();
        run.report("qgc", static_cast<double>(files.size()) / static_cast<double>(missions->size()));
    }
    return files;
}

bool recognises(std::string_view path, std::string_view first_bytes) {
    const bool brace = first_bytes.substr(0, 16).find('{') != std::string_view::npos;
    const bool plan = first_bytes.find("\"fileType\"") != std::string_view::npos;
    return brace && (path.ends_with(".plan") || plan);
}

constexpr Format kQgcPlan{
    "qgc",      "QGroundControl plans, one a drone: places without times, with fence and rally point",
    "none",     "curves, times, lights, yaw, events, cues and limits",
    write,      read_qgc_plan,
    recognises, unsuited_for_missions};

}  // namespace

const Format& qgc_plan_format() {
    return kQgcPlan;
}

}  // namespace aerogram::exporter
