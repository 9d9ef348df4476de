#include "export/certificate_json.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "export/bytes/json_fields.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

using Json = nlohmann::ordered_json;
using Field = json::Field<Json>;
using planner::ActCertificate, planner::Encounter;
constexpr double kNoTurnRate_dps = std::numeric_limits<double>::infinity();
constexpr std::array kRoles{"takeoff", "transit", "hold", "landing"};

Json or_null(const std::optional<double>& value) {
    return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

Json to_json(const ActCertificate& act) {
    const std::optional<Encounter>& closest = act.separation.closest;
    const double start_s = seconds_from_ms(act.start_ms);
    Json json{{"name", act.name},
              {"role", kRoles.at(static_cast<std::size_t>(act.role))},
              {"certified", act.certified()},
              {"start_s", start_s},
              {"duration_s", seconds_from_ms(act.duration_ms)},
              {"required_separation_m", act.required_separation_m},
              {"min_separation_m", or_null(act.separation.lower_bound_m)},
              {"closest_m", closest ? Json(closest->distance_m) : Json(nullptr)},
              {"pair", closest ? Json::array({closest->first.number(), closest->second.number()}) : Json(nullptr)},
              {"time_s", closest ? Json(start_s + closest->time_s) : Json(nullptr)},
              {"max_speed_horizontal_mps", act.extremes.speed_horizontal_mps},
              {"max_speed_up_mps", act.extremes.speed_up_mps},
              {"max_speed_down_mps", act.extremes.speed_down_mps},
              {"max_acceleration_mps2", act.extremes.acceleration_mps2},
              {"max_jerk_mps3", act.extremes.jerk_mps3},
              {"altitude_min_m", act.altitude_min_m},
              {"altitude_max_m", act.altitude_max_m},
              {"geofence_margin_m", or_null(act.geofence_margin_m)},
              {"audience_margin_m", or_null(act.audience_margin_m)},
              {"obstacle_margin_m", or_null(act.obstacle_margin_m)},
              {"method", act.method},
              {"assignment", act.assignment},
              {"path_ratio", act.path_ratio},
              {"separation_by", act.separation_by},
              {"separation_rounds", act.separation_rounds},
              {"violations", act.violations}};
    if (!act.chosen_because.empty()) json["chosen_because"] = act.chosen_because;
    if (act.plane) {
        json["min_airspeed_mps"] = act.plane->airspeed_min_mps.value;
        json["max_airspeed_mps"] = act.plane->airspeed_max_mps.value;
        json["max_turn_rate_dps"] = or_null(act.plane->turn_rate_dps.value);
    }
    return json;
}

std::string role(const Field& field) {
    const std::string name = field.text();
    for (const char* known : kRoles) {
        if (name == known) return name;
    }
    field.wrong("must be takeoff, transit, hold or landing");
}

std::optional<std::pair<std::size_t, std::size_t>> pair(const Field& field) {
    if (field.is_null()) return std::nullopt;
    const std::vector<Field> numbers = field.list();
    if (numbers.size() != 2 || numbers[0].count() == 0 || numbers[1].count() == 0) field.wrong("must be two drones");
    return std::pair<std::size_t, std::size_t>{numbers[0].count(), numbers[1].count()};
}

CertifiedAct act(const Field& field) {
    CertifiedAct a;
    a.name = field["name"].text();
    a.role = role(field["role"]);
    a.certified = field["certified"].truth();
    a.start_s = field["start_s"].number();
    a.duration_s = field["duration_s"].number(0.0);
    a.required_separation_m = field["required_separation_m"].number(0.0);
    a.min_separation_m = field["min_separation_m"].number_or_null();
    a.closest_m = field["closest_m"].number_or_null();
    a.pair = pair(field["pair"]);
    a.time_s = field["time_s"].number_or_null();
    a.speed_horizontal_mps = field["max_speed_horizontal_mps"].number();
    a.speed_up_mps = field["max_speed_up_mps"].number();
    a.speed_down_mps = field["max_speed_down_mps"].number();
    a.acceleration_mps2 = field["max_acceleration_mps2"].number();
    a.jerk_mps3 = field["max_jerk_mps3"].number();
    a.altitude_min_m = field["altitude_min_m"].number();
    a.altitude_max_m = field["altitude_max_m"].number();
    a.geofence_margin_m = field["geofence_margin_m"].number_or_null();
    a.audience_margin_m = field["audience_margin_m"].number_or_null();
    a.obstacle_margin_m = field["obstacle_margin_m"].number_or_null();
    if (field.has("min_airspeed_mps")) {
        // No rate at all is claimed where it is null: somebody stands in the air.
        const double turn_rate_dps = field["max_turn_rate_dps"].number_or_null().value_or(kNoTurnRate_dps);
        a.plane = {field["min_airspeed_mps"].number(), field["max_airspeed_mps"].number(), turn_rate_dps};
    }
    a.method = field["method"].text();
    if (field.has("chosen_because")) a.chosen_because = field["chosen_because"].text();
    a.assignment = field["assignment"].text();
    a.path_ratio = field["path_ratio"].number();
    a.separation_by = field["separation_by"].text();
    a.separation_rounds = static_cast<int>(field["separation_rounds"].number(0.0));
    a.violations = field["violations"].texts();
    return a;
}

CertificateRecord certificate(const Field& root) {
    CertificateRecord record;
    record.show_name = root["show"].text();
    record.show_hash = root["show_hash"].sha256();
    record.certified = root["certified"].truth();
    record.min_separation_m = root["min_separation_m"].number_or_null();
    record.violations = root["violations"].texts();
    for (const Field& a : root["acts"].list()) record.acts.push_back(act(a));
    return record;
}

}  // namespace

std::string certificate_json(const planner::FlightPlan& plan, std::string_view show_hash, bool certified) {
    const planner::Certificate& certificate = plan.certificate;
    std::optional<double> min_separation_m;
    if (!certificate.acts.empty()) min_separation_m = certificate.min_separation_m();
    Json root{{"show", plan.name},
              {"show_hash", std::string(show_hash)},
              {"certified", certified},
              {"min_separation_m", or_null(min_separation_m)},
              {"violations", certificate.violations},
              {"acts", Json::array()}};
    for (const ActCertificate& a : certificate.acts) root["acts"].push_back(to_json(a));
    return root.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Result<CertificateRecord> read_certificate(std::string_view bytes) {
    const auto bad = [](const std::string& what) {
        return Error{ErrorCode::invalid_input, "certificate.json: " + what};
    };
    try {
        const Json root = Json::parse(bytes);
        return certificate(Field(root, ""));
    } catch (const json::BadField& problem) {
        return bad(problem.what());
    } catch (const Json::exception& problem) {
        return bad(problem.what());
    }
}

}  // namespace aerogram::exporter
