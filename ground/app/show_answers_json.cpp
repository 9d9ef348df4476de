#include <array>
#include <nlohmann/json.hpp>

#include "geo/color.hpp"
#include "geo/units.hpp"
#include "geo/utc.hpp"
#include "ground/app/answers.hpp"

/// Answers about shows that were read from files.
namespace aerogram::ground {
namespace {

using Json = nlohmann::ordered_json;

std::string text(const Json& json) {
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

template <class T>
Json or_null(const std::optional<T>& value) {
    return value ? Json(*value) : Json(nullptr);
}

Json vector_json(const Vec3& p) {
    return Json::array({p.x, p.y, p.z});
}

Json place_json(const geo::Geodetic& place) {
    return {{"latitude_deg", place.latitude_deg}, {"longitude_deg", place.longitude_deg}};
}

Json origin_json(const std::optional<geo::ShowOrigin>& origin) {
    if (!origin) return nullptr;
    Json json = place_json(origin->ground);
    json["height_m"] = origin->ground.height_m;
    json["heading_deg"] = origin->heading_deg;
    json["geoid_undulation_m"] = or_null(origin->geoid_undulation_m);
    return json;
}

Json limits_json(const std::optional<Limits>& limits) {
    if (!limits) return nullptr;
    return {{"min_separation_m", limits->min_separation_m},
            {"export_margin_m", limits->export_margin_m},
            {"downwash", limits->downwash},
            {"formation_spacing_m", limits->formation_spacing_m},
            {"speed_horizontal_mps", limits->speed_horizontal_mps},
            {"speed_up_mps", limits->speed_up_mps},
            {"speed_down_mps", limits->speed_down_mps},
            {"acceleration_mps2", limits->acceleration_mps2},
            {"jerk_mps3", limits->jerk_mps3},
            {"min_navigation_altitude_m", limits->min_navigation_altitude_m},
            {"ceiling_m", limits->ceiling_m},
            {"plane", limits->plane.has_value()}};
}

Json items_json(const std::vector<exporter::Waypoint>& waypoints) {
    constexpr std::array kKinds{"takeoff", "fly_to", "land"};
    Json items = Json::array();
    for (const exporter::Waypoint& waypoint : waypoints) {
        Json item = {{"kind", kKinds[static_cast<std::size_t>(waypoint.kind)]}};
        item.update(place_json(waypoint.place));
        item["altitude_above_home_m"] = waypoint.altitude_above_home_m;
        item["hold_s"] = waypoint.hold_s;
        item["until_s"] = or_null(waypoint.until_s);
        item["speed_mps"] = or_null(waypoint.speed_mps);
        items.push_back(item);
    }
    return items;
}

Json drone_json(const exporter::RecordedDrone& drone, const std::vector<double>& at_s) {
    Json entry = {{"name", drone.name},
                  {"home_m", drone.home_m ? vector_json(*drone.home_m) : Json(nullptr)},
                  {"land_m", drone.land_m ? vector_json(*drone.land_m) : Json(nullptr)},
                  {"pieces", drone.pieces.size()},
                  {"waypoints", drone.waypoints.size()},
                  {"light_keys", drone.tracks.lights.size()},
                  {"yaw_keys", drone.tracks.yaw.size()},
                  {"events", drone.tracks.events.size()}};
    if (!drone.waypoints.empty()) entry["items"] = items_json(drone.waypoints);
    if (drone.home) entry["home"] = place_json(*drone.home);
    if (at_s.empty() || drone.pieces.empty()) return entry;
    Json states = Json::array();
    for (const double t_s : at_s) {
        states.push_back({{"time_s", t_s},
                          {"position_m", vector_json(exporter::position_at(drone, t_s))},
                          {"color", hex_from_rgb(light_at(drone.tracks.lights, t_s))}});
    }
    entry["at"] = states;
    return entry;
}

Json deviation_json(const exporter::Converted& converted) {
    if (!converted.deviation) return nullptr;
    return {{"position_m", converted.deviation->position_m}, {"time_s", converted.deviation->time_s}};
}

Json paths_json(const std::vector<std::filesystem::path>& paths) {
    Json list = Json::array();
    for (const auto& path : paths) list.push_back(path.string());
    return list;
}

}  // namespace

std::string inspect_answer(const exporter::OpenedShow& opened, const std::vector<double>& at_s,
                           const std::optional<std::filesystem::path>& picture) {
    const exporter::RecordedShow& show = opened.show;
    Json drones = Json::array(), cues = Json::array();
    for (const auto& drone : show.drones) drones.push_back(drone_json(drone, at_s));
    for (const Cue& cue : show.cues) cues.push_back({{"name", cue.name}, {"time_s", seconds_from_ms(cue.time_ms)}});
    const exporter::Rounding& r = show.rounding;
    Json airspace;
    if (show.airspace) {
        airspace = {{"geofence_corners", show.airspace->geofence_m.size()},
                    {"audience_areas", show.airspace->audience_m.size()},
                    {"obstacles", show.airspace->obstacles.size()}};
    }
    return text({{"format", show.format},
                 {"files", paths_json(opened.files)},
                 {"completed_from", opened.completed_from.empty() ? Json(nullptr) : Json(opened.completed_from)},
                 {"title", show.title},
                 {"show_hash", or_null(show.show_hash)},
                 {"certified", or_null(show.certified)},
                 {"timed", show.timed},
                 {"timing", show.timing.empty() ? std::string(opened.format->timing) : show.timing},
                 {"duration_s", show.duration_s},
                 {"origin", origin_json(show.origin)},
                 {"limits", limits_json(show.limits)},
                 {"airspace", airspace},
                 {"endurance_s", or_null(show.endurance_s)},
                 {"rounding", {{"position_m", r.position_m}, {"fit_m", r.fit_m}, {"time_s", r.time_s}}},
                 {"drones", drones},
                 {"cues", cues},
                 {"picture", picture ? Json(picture->string()) : Json(nullptr)}});
}

std::string convert_answer(const exporter::Converted& converted) {
    return text({{"from", converted.from},
                 {"format", converted.format},
                 {"files", paths_json(converted.files)},
                 {"drones", converted.drones},
                 {"timed", converted.timed},
                 {"stated_m", converted.stated_m},
                 {"deviation", deviation_json(converted)},
                 {"certified", converted.certified},
                 {"no_longer_certified", converted.no_longer_certified},
                 {"completed_from", converted.completed_from},
                 {"assumed", converted.assumed},
                 {"lost", converted.lost}});
}

std::string import_answer(const exporter::Imported& imported) {
    return text({{"from", imported.from},
                 {"files", paths_json(imported.files)},
                 {"drones", imported.drones},
                 {"keyframes", imported.keyframes},
                 {"accuracy_m", imported.accuracy_m},
                 {"plans", imported.plans},
                 {"cannot_plan", imported.cannot_plan},
                 {"completed_from", imported.completed_from},
                 {"assumed", imported.assumed},
                 {"lost", imported.left}});
}

}  // namespace aerogram::ground
