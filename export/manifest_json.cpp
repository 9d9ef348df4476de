#include "export/manifest_json.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <set>

#include "export/bytes/json_fields.hpp"
#include "export/bytes/sha256.hpp"
#include "geo/contract.hpp"

namespace aerogram::exporter {
namespace {

using Json = nlohmann::ordered_json;
using Field = json::Field<Json>;
constexpr unsigned kManifestVersion = 1;
constexpr std::string_view kHashKey = "\"manifest_sha256\": \"";
constexpr std::size_t kHashDigits = 64;

struct NamedLimit {
    const char* key;
    double Limits::*value;
};
constexpr std::array kLimits{
    NamedLimit{"min_separation_m", &Limits::min_separation_m},
    NamedLimit{"formation_spacing_m", &Limits::formation_spacing_m},
    NamedLimit{"downwash", &Limits::downwash},
    NamedLimit{"export_margin_m", &Limits::export_margin_m},
    NamedLimit{"speed_horizontal_mps", &Limits::speed_horizontal_mps},
    NamedLimit{"speed_up_mps", &Limits::speed_up_mps},
    NamedLimit{"speed_down_mps", &Limits::speed_down_mps},
    NamedLimit{"acceleration_mps2", &Limits::acceleration_mps2},
    NamedLimit{"jerk_mps3", &Limits::jerk_mps3},
    NamedLimit{"min_navigation_altitude_m", &Limits::min_navigation_altitude_m},
    NamedLimit{"ceiling_m", &Limits::ceiling_m},
};

struct NamedPlaneLimit {
    const char* key;
    double PlaneLimits::*value;
};
constexpr std::array kPlaneLimits{
    NamedPlaneLimit{"airspeed_min_mps", &PlaneLimits::airspeed_min_mps},
    NamedPlaneLimit{"airspeed_max_mps", &PlaneLimits::airspeed_max_mps},
    NamedPlaneLimit{"turn_rate_dps", &PlaneLimits::turn_rate_dps},
    NamedPlaneLimit{"climb_mps", &PlaneLimits::climb_mps},
    NamedPlaneLimit{"sink_mps", &PlaneLimits::sink_mps},
};

// --- writing ---

Json or_null(const std::optional<double>& value) {
    return value ? Json(*value) : Json(nullptr);
}

Json to_json(const geo::ShowOrigin& origin) {
    return {{"latitude_deg", origin.ground.latitude_deg},
            {"longitude_deg", origin.ground.longitude_deg},
            {"height_m", origin.ground.height_m},
            {"heading_deg", origin.heading_deg},
            {"geoid_undulation_m", or_null(origin.geoid_undulation_m)}};
}

Json to_json(const Limits& limits) {
    Json object = Json::object();
    for (const NamedLimit& limit : kLimits) object[limit.key] = limits.*limit.value;
    if (!limits.plane) return object;
    Json& plane = object["plane"] = Json::object();
    for (const NamedPlaneLimit& limit : kPlaneLimits) plane[limit.key] = (*limits.plane).*limit.value;
    return object;
}

Json to_json(const geo::Polygon& polygon) {
    Json list = Json::array();
    for (const Vec2& p : polygon) list.push_back(Json::array({p.x, p.y}));
    return list;
}

Json to_json(const geo::Obstacle& obstacle) {
    Json object{{"name", obstacle.name}, {"base_m", obstacle.base_m}, {"height_m", obstacle.height_m}};
    if (const auto* cylinder = std::get_if<geo::Cylinder>(&obstacle.shape)) {
        object["center_m"] = Json::array({cylinder->center_m.x, cylinder->center_m.y});
        object["radius_m"] = cylinder->radius_m;
    } else {
        object["outline_m"] = to_json(std::get<geo::Prism>(obstacle.shape).outline_m);
    }
    return object;
}

Json to_json(const geo::Airspace& air) {
    Json object{{"geofence_m", to_json(air.geofence_m)}, {"audience_m", Json::array()}, {"obstacles", Json::array()}};
    for (const geo::Polygon& area : air.audience_m) object["audience_m"].push_back(to_json(area));
    for (const geo::Obstacle& obstacle : air.obstacles) object["obstacles"].push_back(to_json(obstacle));
    return object;
}

Json to_json(const ManifestFormat& format) {
    if (!format.skipped.empty()) return {{"name", format.name}, {"skipped", format.skipped}};
    const Rounding& r = format.rounding;
    return {
        {"name", format.name},
        {"rounding",
         {{"position_m", r.position_m},
          {"fit_m", r.fit_m},
          {"time_s", r.time_s},
          {"speed_allowance_mps", r.has_speed ? Json(r.speed_allowance_mps) : Json(nullptr)},
          {"acceleration_allowance_mps2", r.has_acceleration ? Json(r.acceleration_allowance_mps2) : Json(nullptr)}}}};
}

Json to_json(const ManifestFile& file) {
    Json object{{"path", file.path}, {"format", file.format}, {"bytes", file.bytes}, {"sha256", file.sha256}};
    if (file.timing) {
        object["timing"] = *file.timing;
        object["min_separation_m"] = or_null(file.min_separation_m);
    }
    return object;
}

// --- reading ---

Vec2 vec2(const Field& field) {
    const std::vector<double> v = field.numbers(2);
    return {v[0], v[1]};
}

geo::Polygon polygon(const Field& field, bool may_be_empty) {
    geo::Polygon outline;
    for (const Field& point : field.list()) outline.push_back(vec2(point));
    if (outline.size() < 3 && !(outline.empty() && may_be_empty)) field.wrong("must have at least 3 points");
    return outline;
}

geo::ShowOrigin origin(const Field& field) {
    geo::ShowOrigin o;
    o.ground = {field["latitude_deg"].number(-90.0, 90.0), field["longitude_deg"].number(-180.0, 180.0),
                field["height_m"].number()};
    o.heading_deg = field["heading_deg"].number();
    o.geoid_undulation_m = field["geoid_undulation_m"].number_or_null();
    return o;
}

Limits read_limits(const Field& field) {
    Limits limits;
    for (const NamedLimit& limit : kLimits) limits.*limit.value = field[limit.key].number(0.0);
    if (limits.downwash < 1.0) field["downwash"].wrong("must be at least 1");
    if (!field.has("plane")) return limits;
    limits.plane.emplace();
    for (const NamedPlaneLimit& limit : kPlaneLimits)
        (*limits.plane).*limit.value = field["plane"][limit.key].number(0.0);
    return limits;
}

geo::Obstacle obstacle(const Field& field) {
    geo::Obstacle o;
    o.name = field["name"].text();
    o.base_m = field["base_m"].number();
    o.height_m = field["height_m"].number();
    if (field.has("radius_m")) {
        o.shape = geo::Cylinder{vec2(field["center_m"]), field["radius_m"].number(0.0)};
    } else {
        o.shape = geo::Prism{polygon(field["outline_m"], false)};
    }
    return o;
}

geo::Airspace airspace(const Field& field) {
    geo::Airspace air;
    air.geofence_m = polygon(field["geofence_m"], true);
    for (const Field& area : field["audience_m"].list()) air.audience_m.push_back(polygon(area, false));
    for (const Field& o : field["obstacles"].list()) air.obstacles.push_back(obstacle(o));
    return air;
}

ManifestFormat format(const Field& field) {
    ManifestFormat result{field["name"].text(), field.has("skipped") ? field["skipped"].text() : "", {}};
    if (!result.skipped.empty()) return result;
    const Field rounding = field["rounding"];
    Rounding& r = result.rounding;
    r.position_m = rounding["position_m"].number(0.0);
    r.fit_m = rounding["fit_m"].number(0.0);
    r.time_s = rounding["time_s"].number(0.0);
    const std::optional<double> speed = rounding["speed_allowance_mps"].number_or_null();
    const std::optional<double> acceleration = rounding["acceleration_allowance_mps2"].number_or_null();
    r.has_speed = speed.has_value();
    r.speed_allowance_mps = speed.value_or(0.0);
    r.has_acceleration = acceleration.has_value();
    r.acceleration_allowance_mps2 = acceleration.value_or(0.0);
    return result;
}

ManifestFile file(const Field& field) {
    ManifestFile f;
    f.path = field["path"].text();
    const std::string framed = "/" + f.path + "/";
    const bool leaves = f.path.empty() || framed.find("//") != std::string::npos ||
                        framed.find("/../") != std::string::npos || framed.find("/./") != std::string::npos ||
                        f.path.find('\0') != std::string::npos;
    if (leaves) field["path"].wrong("must stay inside the folder");
    f.format = field["format"].text();
    f.bytes = field["bytes"].count();
    f.sha256 = field["sha256"].sha256();
    if (field.has("timing")) {
        f.timing = field["timing"].text();
        f.min_separation_m = field["min_separation_m"].number_or_null();
    }
    return f;
}

Manifest manifest(const Field& root) {
    if (root["manifest_version"].count() != kManifestVersion) root["manifest_version"].wrong("must be 1");
    Manifest m;
    m.program = root["program"].text();
    m.version = root["version"].text();
    m.show_name = root["show"].text();
    m.show_hash = root["show_hash"].sha256();
    m.certified = root["certified"].truth();
    m.duration_s = root["duration_s"].number(0.0);
    m.origin = origin(root["origin"]);
    m.limits = read_limits(root["limits"]);
    m.endurance_s = root["endurance_s"].number();
    m.airspace = airspace(root["airspace"]);
    for (const Field& f : root["formats"].list()) m.formats.push_back(format(f));
    std::set<std::string> paths;
    for (const Field& f : root["files"].list()) {
        m.files.push_back(file(f));
        if (!paths.insert(m.files.back().path).second) f["path"].wrong("occurs twice");
    }
    for (const Field& d : root["drones"].list()) {
        const std::vector<double> pad = d["pad_m"].numbers(3);
        m.drones.push_back({d["name"].text(), {pad[0], pad[1], pad[2]}});
    }
    if (root["drone_count"].count() != m.drones.size()) root["drone_count"].wrong("is not the number of drones listed");
    m.fleet = root["fleet"].count();
    if (m.fleet < m.drones.size()) root["fleet"].wrong("is less than the number of drones listed");
    return m;
}

/// Where the 64 digits of the manifest's own hash begin. Inside strings quotes are escaped, so the key occurs once.
std::optional<std::size_t> hash_digits(std::string_view text) {
    const std::size_t key = text.find(kHashKey);
    if (key == std::string_view::npos || text.find(kHashKey, key + 1) != std::string_view::npos) return std::nullopt;
    const std::size_t digits = key + kHashKey.size();
    if (text.size() < digits + kHashDigits + 1 || text[digits + kHashDigits] != '"') return std::nullopt;
    return digits;
}

}  // namespace

std::string manifest_json(const Manifest& m) {
    Json root{{"manifest_version", kManifestVersion},
              {"program", m.program},
              {"version", m.version},
              {"show", m.show_name},
              {"show_hash", m.show_hash},
              {"manifest_sha256", std::string(kHashDigits, '0')},
              {"certified", m.certified},
              {"drone_count", m.drones.size()},
              {"fleet", m.fleet},
              {"duration_s", m.duration_s},
              {"origin", to_json(m.origin)},
              {"limits", to_json(m.limits)},
              {"endurance_s", m.endurance_s},
              {"airspace", to_json(m.airspace)},
              {"formats", Json::array()},
              {"files", Json::array()},
              {"drones", Json::array()}};
    for (const ManifestFormat& f : m.formats) root["formats"].push_back(to_json(f));
    for (const ManifestFile& f : m.files) root["files"].push_back(to_json(f));
    for (const ManifestDrone& d : m.drones) {
        root["drones"].push_back({{"name", d.name}, {"pad_m", {d.pad_m.x, d.pad_m.y, d.pad_m.z}}});
    }
    std::string text = root.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
    const std::optional<std::size_t> digits = hash_digits(text);
    AEROGRAM_REQUIRE(digits.has_value());
    return text.replace(*digits, kHashDigits, sha256_hex(text));
}

Result<Manifest> read_manifest(std::string_view bytes) {
    const auto bad = [](const std::string& what) { return Error{ErrorCode::invalid_input, "manifest.json: " + what}; };
    const std::optional<std::size_t> digits = hash_digits(bytes);
    if (!digits) return bad("manifest_sha256 is missing");
    std::string zeroed(bytes);
    zeroed.replace(*digits, kHashDigits, std::string(kHashDigits, '0'));
    if (sha256_hex(zeroed) != bytes.substr(*digits, kHashDigits)) {
        return bad("its own SHA-256 (manifest_sha256) does not fit: the file was altered");
    }
    try {
        const Json root = Json::parse(bytes);
        return manifest(Field(root, ""));
    } catch (const json::BadField& problem) {
        return bad(problem.what());
    } catch (const Json::exception& problem) {
        return bad(problem.what());
    }
}

}  // namespace aerogram::exporter
