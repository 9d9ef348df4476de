#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "export/report/report_files.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}
Json number(const std::optional<double>& value) {
    return value ? number(*value) : Json(nullptr);
}
Json point(const Vec3& p) {
    return Json::array({p.x, p.y, p.z});
}
Json point(const Vec2& p) {
    return Json::array({p.x, p.y});
}
template <class List, class Each>
Json list(const List& all, const Each& each) {
    Json array = Json::array();
    for (const auto& one : all) array.push_back(each(one));
    return array;
}
Json outline(const geo::Polygon& polygon) {
    return list(polygon, [](const Vec2& p) { return point(p); });
}
Json points(const Points& all) {
    return list(all, [](const Vec3& p) { return point(p); });
}

Json rule(const ReportRule& r) {
    return {{"rule", r.rule},
            {"title", r.title},
            {"unit", r.unit},
            {"at_least", r.at_least},
            {"limit", number(r.limit)},
            {"worst", number(r.worst)},
            {"allowance", number(r.allowance)},
            {"margin", number(r.margin)},
            {"drones", r.drones},
            {"time_s", number(r.time_s)},
            {"place_m", r.place_m ? point(*r.place_m) : Json(nullptr)},
            {"held", r.held}};
}

Json limits(const Limits& l) {
    Json json{{"min_separation_m", l.min_separation_m},
              {"formation_spacing_m", l.formation_spacing_m},
              {"downwash", l.downwash},
              {"export_margin_m", l.export_margin_m},
              {"speed_horizontal_mps", l.speed_horizontal_mps},
              {"speed_up_mps", l.speed_up_mps},
              {"speed_down_mps", l.speed_down_mps},
              {"acceleration_mps2", l.acceleration_mps2},
              {"jerk_mps3", l.jerk_mps3},
              {"min_navigation_altitude_m", l.min_navigation_altitude_m},
              {"ceiling_m", l.ceiling_m},
              {"plane", nullptr}};
    if (l.plane) {
        json["plane"] = {{"airspeed_min_mps", l.plane->airspeed_min_mps},
                         {"airspeed_max_mps", l.plane->airspeed_max_mps},
                         {"turn_rate_dps", l.plane->turn_rate_dps},
                         {"climb_mps", l.plane->climb_mps},
                         {"sink_mps", l.plane->sink_mps}};
    }
    return json;
}

Json origin(const std::optional<geo::ShowOrigin>& o) {
    if (!o) return nullptr;
    return {{"latitude_deg", o->ground.latitude_deg},
            {"longitude_deg", o->ground.longitude_deg},
            {"height_m", o->ground.height_m},
            {"heading_deg", o->heading_deg},
            {"geoid_undulation_m", number(o->geoid_undulation_m)}};
}

Json airspace(const geo::Airspace& air) {
    const auto obstacle = [](const geo::Obstacle& o) {
        Json json{{"name", o.name}, {"base_m", o.base_m}, {"height_m", o.height_m}};
        if (const auto* cylinder = std::get_if<geo::Cylinder>(&o.shape)) {
            json["center_m"] = point(cylinder->center_m);
            json["radius_m"] = cylinder->radius_m;
        } else {
            json["outline_m"] = outline(std::get<geo::Prism>(o.shape).outline_m);
        }
        return json;
    };
    return {{"geofence_m", outline(air.geofence_m)},
            {"audience_m", list(air.audience_m, outline)},
            {"obstacles", list(air.obstacles, obstacle)}};
}

Json volumes(const FlightVolumes& v) {
    return {{"flight_m", outline(v.flight_m)},
            {"contingency_m", outline(v.contingency_m)},
            {"ground_risk_m", outline(v.ground_risk_m)},
            {"flight_height_m", number(v.flight_height_m)},
            {"contingency_height_m", number(v.contingency_height_m)},
            {"contingency_width_m", number(v.contingency_m_wide)},
            {"ground_risk_width_m", number(v.ground_risk_m_wide)},
            {"speed_mps", number(v.speed_mps)}};
}

Json encounter(const ReportEncounter& e, const char* first, const char* second) {
    return {{first, e.first},
            {second, e.second},
            {"time_s", number(e.time_s)},
            {"distance_m", number(e.distance_m)},
            {"horizontal_m", number(e.horizontal_m)},
            {"vertical_m", number(e.vertical_m)},
            {"place_m", point(e.place_m)}};
}

Json over_time(const Report& r) {
    const auto series = [](const ReportSeries& s) {
        return Json{{"name", s.name},
                    {"unit", s.unit},
                    {"limit", number(s.limit)},
                    {"lower_limit", number(s.lower_limit)},
                    {"values", list(s.values, [](double v) { return number(v); })}};
    };
    return {{"step_s", r.step_s},
            {"times_s", r.times_s},
            {"series", list(r.series, series)},
            {"nearest_m", list(r.nearest_m, [](double v) { return number(v); })}};
}

Json approach(const ReportApproach& a) {
    if (!a.distance_m) return nullptr;
    return {{"distance_m", *a.distance_m}, {"first", a.first}, {"second", a.second}, {"time_s", a.time_s}};
}

Json emergency(const ReportEmergency& e) {
    return {{"time_s", e.time_s},
            {"one_holds", approach(e.one_holds)},
            {"one_lands", approach(e.one_lands)},
            {"one_returns", approach(e.one_returns)},
            {"all_hold", approach(e.all_hold)},
            {"all_land", approach(e.all_land)},
            {"all_return", approach(e.all_return)}};
}

Json energy(const ReportEnergy& e) {
    return {{"model", e.model},
            {"mean_used_share", number(e.mean_used)},
            {"most_used_share", number(e.most_used)},
            {"most_used_by", e.most_used_by},
            {"least_reserve_share", number(e.least_reserve)},
            {"wanted_reserve_share", number(e.wanted_reserve)},
            {"held", e.held}};
}

Json sensitivity(const ReportSensitivity& s) {
    return {{"change", s.change},
            {"geofence_margin_m", number(s.geofence_margin_m)},
            {"audience_margin_m", number(s.audience_margin_m)},
            {"obstacle_margin_m", number(s.obstacle_margin_m)},
            {"farthest_moved_m", number(s.farthest_moved_m)},
            {"held", s.held}};
}

Json lights(const ReportLights& l) {
    return {{"keys", l.keys},
            {"most_keys_per_s", number(l.most_keys_per_s)},
            {"fastest_flash_hz", number(l.fastest_flash_hz)},
            {"fleet_flash_hz", number(l.fleet_flash_hz)},
            {"fleet_flash_s", number(l.fleet_flash_s)},
            {"warning", l.warning}};
}

Json format(const ReportFormat& f) {
    return {{"name", f.name},
            {"timing", f.timing},
            {"skipped", f.skipped},
            {"files", f.files},
            {"min_separation_m", number(f.min_separation_m)},
            {"position_error_m", number(f.position_error_m)},
            {"problems", f.problems},
            {"held", f.held}};
}

Json page_one(const Report& r) {
    return {{"title", r.title},
            {"show_hash", r.show_hash},
            {"program", r.program},
            {"version", r.version},
            {"certified", r.certified},
            {"reasons", r.reasons},
            {"warnings", r.warnings},
            {"profile", r.profile},
            {"drones", r.drones},
            {"duration_s", r.duration_s},
            {"wind_mps", r.wind_mps},
            {"endurance_s", r.endurance_s},
            {"origin", origin(r.origin)},
            {"limits", limits(r.limits)},
            {"min_separation_m", number(r.min_separation_m)},
            {"rules", list(r.rules, rule)}};
}

Json places(const Report& r) {
    return {{"airspace", airspace(r.airspace)},
            {"volumes", volumes(r.volumes)},
            {"homes_m", points(r.homes_m)},
            {"tracks_m", list(r.tracks_m, points)}};
}

Json keyframe(const OutgoingKeyframe& k) {
    return {{"name", k.name},
            {"stands_from_s", seconds_from_ms(k.stands_from_ms)},
            {"stands_to_s", seconds_from_ms(k.stands_to_ms)}};
}

Json turn(const ReportTurn& t) {
    return {{"drone", t.drone},
            {"leaves_s", number(t.leaves_s)},
            {"lands_s", number(t.lands_s)},
            {"home_m", point(t.home_m)},
            {"land_m", point(t.land_m)}};
}

}  // namespace

std::string report_json(const Report& r) {
    const auto of_two = [](const ReportEncounter& e) { return encounter(e, "first", "second"); };
    const auto above = [](const ReportEncounter& e) { return encounter(e, "upper", "lower"); };
    Json json{{"report", "aerogram-flight-validation"}, {"report_version", 1}};
    json.update(page_one(r));
    json["over_time"] = over_time(r);
    json["histogram"] = {{"step_m", r.histogram_step_m}, {"drone_instants", r.histogram}};
    json["keyframes"] = list(r.keyframes, keyframe);
    json["encounters"] = list(r.encounters, of_two);
    json["alignments"] = {
        {"radius_m", r.alignment_radius_m}, {"height_m", r.alignment_height_m}, {"closest", list(r.alignments, above)}};
    json["places"] = places(r);
    json["turns"] = list(r.turns, turn);
    json["energy"] = energy(r.energy);
    json["emergencies"] = {{"model", r.emergency_model},
                           {"resolution_m", number(r.emergency_resolution_m)},
                           {"seconds", list(r.emergencies, emergency)}};
    json["sensitivities"] = list(r.sensitivities, sensitivity);
    json["lights"] = lights(r.lights);
    json["formats"] = list(r.formats, format);
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace aerogram::exporter
