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

Json path_json(const std::optional<std::filesystem::path>& path) {
    return path ? Json(path->string()) : Json(nullptr);
}

Json slots_json(const InspectedFormation& inspected) {
    const planner::Formation& formation = inspected.formation;
    Json slots = Json::array();
    for (std::size_t i = 0; i < formation.points_m.size(); ++i) {
        slots.push_back({{"position_m", vector_json(formation.points_m[i])},
                         {"color", hex_from_rgb(formation.colors[i])},
                         {"part", formation.spare[i] ? Json(nullptr) : Json(formation.part[i] + 1)},
                         {"spare", bool{formation.spare[i]}}});
    }
    return slots;
}

Json formation_json(const InspectedFormation& inspected) {
    const exporter::FormationFacts& facts = inspected.facts;
    Json closest, spacing, coverage = Json::array();
    if (facts.closest) {
        closest = Json::array({facts.closest->first + 1, facts.closest->second + 1});
        spacing = facts.closest->distance_m;
    }
    for (const auto& each : facts.coverage_m) coverage.push_back(or_null(each));
    return {{"mission", facts.show},
            {"keyframe", facts.keyframe},
            {"number", facts.number},
            {"keyframes", facts.keyframes},
            {"drones", facts.drones},
            {"spares", facts.spares},
            {"formation_spacing_m", facts.asked_spacing_m},
            {"downwash", facts.downwash},
            {"smallest_spacing_m", spacing},
            {"closest_slots", closest},
            {"low_m", vector_json(facts.low_m)},
            {"high_m", vector_json(facts.high_m)},
            {"size_m", vector_json(facts.high_m - facts.low_m)},
            {"coverage_m", coverage},
            {"note", facts.note},
            {"slots", slots_json(inspected)}};
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

std::string formation_answer(const std::vector<InspectedFormation>& inspected,
                             const std::optional<std::filesystem::path>& picture) {
    if (inspected.size() == 1) {
        Json one = formation_json(inspected.front());
        one["picture"] = path_json(picture);
        return text(one);
    }
    Json all = Json::array();
    for (const InspectedFormation& each : inspected) all.push_back(formation_json(each));
    return text({{"keyframes", all}, {"picture", path_json(picture)}});
}

std::string keyframes_answer(const planner::Mission& mission) {
    Json keyframes = Json::array();
    for (std::size_t k = 0; k < mission.keyframes.size(); ++k) {
        const planner::Keyframe& keyframe = mission.keyframes[k];
        keyframes.push_back({{"number", k + 1},
                             {"name", keyframe.name},
                             {"clip", keyframe.clip.empty() ? Json(nullptr) : Json(keyframe.clip)},
                             {"parts", keyframe.parts.size()},
                             {"hold_s", keyframe.hold_s}});
    }
    return text({{"mission", mission.name}, {"drones", mission.fleet.drones}, {"keyframes", keyframes}});
}

std::string new_answer(const std::filesystem::path& file) {
    return text({{"written", file.string()}});
}

std::string error_answer(const Error& error, int status) {
    return text({{"error", error.message}, {"exit_status", status}});
}

}  // namespace aerogram::ground
