#include "export/outgoing/facts_json.hpp"

#include <nlohmann/json.hpp>

#include "export/outgoing/program.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

using Json = nlohmann::ordered_json;

Json polygon(const geo::Polygon& outline) {
    Json corners = Json::array();
    for (const Vec2& p : outline) corners.push_back(Json::array({p.x, p.y}));
    return corners;
}

Json obstacle(const geo::Obstacle& obstacle) {
    Json result{{"name", obstacle.name}, {"base_m", obstacle.base_m}, {"height_m", obstacle.height_m}};
    if (const auto* cylinder = std::get_if<geo::Cylinder>(&obstacle.shape)) {
        result["center_m"] = {cylinder->center_m.x, cylinder->center_m.y};
        result["radius_m"] = cylinder->radius_m;
    } else {
        result["outline_m"] = polygon(std::get<geo::Prism>(obstacle.shape).outline_m);
    }
    return result;
}

Json airspace(const geo::Airspace& air) {
    Json audience = Json::array(), obstacles = Json::array();
    for (const geo::Polygon& area : air.audience_m) audience.push_back(polygon(area));
    for (const geo::Obstacle& each : air.obstacles) obstacles.push_back(obstacle(each));
    return {{"geofence_m", polygon(air.geofence_m)}, {"audience_m", audience}, {"obstacles", obstacles}};
}

Json limits(const Limits& l) {
    Json result{{"min_separation_m", l.min_separation_m},
                {"formation_spacing_m", l.formation_spacing_m},
                {"downwash", l.downwash},
                {"export_margin_m", l.export_margin_m},
                {"speed_horizontal_mps", l.speed_horizontal_mps},
                {"speed_up_mps", l.speed_up_mps},
                {"speed_down_mps", l.speed_down_mps},
                {"acceleration_mps2", l.acceleration_mps2},
                {"jerk_mps3", l.jerk_mps3},
                {"min_navigation_altitude_m", l.min_navigation_altitude_m},
                {"ceiling_m", l.ceiling_m}};
    if (l.plane) {
        result["plane"] = {{"airspeed_min_mps", l.plane->airspeed_min_mps},
                           {"airspeed_max_mps", l.plane->airspeed_max_mps},
                           {"turn_rate_dps", l.plane->turn_rate_dps},
                           {"climb_mps", l.plane->climb_mps},
                           {"sink_mps", l.plane->sink_mps}};
    }
    return result;
}

Json origin(const geo::ShowOrigin& origin) {
    Json result{{"latitude_deg", origin.ground.latitude_deg},
                {"longitude_deg", origin.ground.longitude_deg},
                {"height_m", origin.ground.height_m},
                {"heading_deg", origin.heading_deg}};
    if (origin.geoid_undulation_m) result["geoid_undulation_m"] = *origin.geoid_undulation_m;
    return result;
}

std::string text_of(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string facts_json(const OutgoingFacts& facts, const Seal& seal) {
    Json json{{"program", std::string(kProgramName) + " " + std::string(kProgramVersion)}, {"title", facts.title}};
    if (!seal.show_hash.empty()) json["show_hash"] = seal.show_hash;
    json["certified"] = seal.certified;
    json["fleet"] = facts.fleet;
    json["duration_s"] = seconds_from_ms(facts.duration_ms);
    json["endurance_s"] = facts.endurance_s;
    if (facts.origin) json["origin"] = origin(*facts.origin);
    json["limits"] = limits(facts.limits);
    json["airspace"] = airspace(facts.airspace);
    Json keyframes = Json::array(), cues = Json::array();
    for (const OutgoingKeyframe& keyframe : facts.keyframes)
        keyframes.push_back(Json{{"name", keyframe.name},
                                 {"from_s", seconds_from_ms(keyframe.stands_from_ms)},
                                 {"to_s", seconds_from_ms(keyframe.stands_to_ms)}});
    for (const Cue& cue : facts.cues)
        cues.push_back(Json{{"name", cue.name}, {"time_s", seconds_from_ms(cue.time_ms)}});
    json["keyframes"] = keyframes;
    json["cues"] = cues;
    return text_of(json);
}

std::string json_text(const std::string& text) {
    return text_of(Json(text));
}

}  // namespace aerogram::exporter
