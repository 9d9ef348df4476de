#include <nlohmann/json.hpp>

#include "geo/color.hpp"
#include "geo/units.hpp"
#include "ground/app/answers.hpp"

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

Json judgement_json(const exporter::Judgement& judgement) {
    Json findings = Json::array();
    for (const exporter::Finding& finding : judgement.findings) {
        findings.push_back({{"rule", finding.rule},
                            {"held", finding.held},
                            {"limit", finding.limit},
                            {"worst", finding.worst},
                            {"allowance", finding.allowance},
                            {"drones", finding.drones},
                            {"time_s", or_null(finding.time_s)}});
    }
    return {{"format", judgement.format},
            {"held", judgement.held()},
            {"limits_from", judgement.limits_from},
            {"min_separation_m", judgement.separation_claimed ? Json(judgement.min_separation_m) : Json(nullptr)},
            {"findings", findings},
            {"problems", judgement.problems}};
}

}  // namespace

std::string plan_answer(const planner::FlightPlan& plan, const exporter::ExportedShow& shown,
                        const std::filesystem::path& out) {
    Json formats = Json::array();
    for (const auto& format : shown.formats) {
        formats.push_back({{"name", format.name},
                           {"files", format.files},
                           {"skipped", format.skipped.empty() ? Json(nullptr) : Json(format.skipped)},
                           {"min_separation_m", format.skipped.empty() && format.judgement.separation_claimed
                                                    ? Json(format.judgement.min_separation_m)
                                                    : Json(nullptr)}});
    }
    Json acts = Json::array();
    for (const auto& act : plan.certificate.acts) {
        acts.push_back({{"name", act.name},
                        {"start_s", seconds_from_ms(act.start_ms)},
                        {"duration_s", seconds_from_ms(act.duration_ms)},
                        {"method", act.method},
                        {"separation_by", act.separation_by},
                        {"assignment", act.assignment},
                        {"min_separation_m", plan.drones() > 1 ? Json(act.separation.lower_bound_m) : Json(nullptr)},
                        {"certified", act.certified()},
                        {"violations", act.violations}});
    }
    return text({{"show", plan.name},
                 {"drones", plan.drones()},
                 {"duration_s", seconds_from_ms(plan.duration_ms())},
                 {"certified", shown.certified},
                 {"min_separation_m", plan.drones() > 1 ? Json(plan.certificate.min_separation_m()) : Json(nullptr)},
                 {"show_hash", shown.show_hash},
                 {"folder", out.string()},
                 {"formats", formats},
                 {"acts", acts}});
}

std::string verify_answer(const std::vector<std::pair<std::filesystem::path, exporter::Verified>>& verified) {
    Json paths = Json::array();
    bool all = true;
    for (const auto& [path, result] : verified) {
        Json shows = Json::array();
        for (const auto& show : result.shows) shows.push_back(judgement_json(show));
        paths.push_back(
            {{"path", path.string()}, {"held", result.held()}, {"problems", result.problems}, {"shows", shows}});
        all = all && result.held();
    }
    return text({{"held", all}, {"paths", paths}});
}

std::string inspect_answer(const exporter::RecordedShow& show, const std::vector<double>& at_s) {
    Json drones = Json::array();
    for (const auto& drone : show.drones) {
        Json entry = {{"name", drone.name},
                      {"home_m", drone.home_m ? vector_json(*drone.home_m) : Json(nullptr)},
                      {"pieces", drone.pieces.size()},
                      {"waypoints", drone.waypoints.size()},
                      {"light_keys", drone.tracks.lights.size()}};
        if (!at_s.empty() && !drone.pieces.empty()) {
            Json states = Json::array();
            for (const double t_s : at_s) {
                states.push_back({{"time_s", t_s},
                                  {"position_m", vector_json(exporter::position_at(drone, t_s))},
                                  {"color", hex_from_rgb(light_at(drone.tracks.lights, t_s))}});
            }
            entry["at"] = states;
        }
        drones.push_back(entry);
    }
    Json cues = Json::array();
    for (const Cue& cue : show.cues) cues.push_back({{"name", cue.name}, {"time_s", seconds_from_ms(cue.time_ms)}});
    return text({{"format", show.format},
                 {"title", show.title},
                 {"show_hash", or_null(show.show_hash)},
                 {"certified", or_null(show.certified)},
                 {"timed", show.timed},
                 {"duration_s", show.duration_s},
                 {"drones", drones},
                 {"cues", cues}});
}

std::string new_answer(const std::filesystem::path& file) {
    return text({{"written", file.string()}});
}

std::string error_answer(const Error& error, int status) {
    return text({{"error", error.message}, {"exit_status", status}});
}

}  // namespace aerogram::ground
