#include "export/picture/formation_facts.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include "export/picture/nearest_distances.hpp"
#include "geo/contract.hpp"

namespace aerogram::exporter {
namespace {

std::string slot_name(std::size_t index) {
    return std::to_string(SlotId(index).number());
}

std::string spacing_text(const FormationFacts& facts) {
    if (!facts.closest) return "none, one drone alone";
    return fixed(facts.closest->distance_m, 2) + " m, slots " + slot_name(facts.closest->first) + " and " +
           slot_name(facts.closest->second) + " (asked " + fixed(facts.asked_spacing_m, 2) + " m" +
           (facts.downwash == 1.0 ? ")" : ", downwash " + fixed(facts.downwash, 2) + ")");
}

std::optional<std::string> coverage_text(const FormationFacts& facts) {
    std::string text;
    bool any = false;
    for (const auto& coverage_m : facts.coverage_m) {
        text += (text.empty() ? "" : ", ") + (coverage_m ? fixed(*coverage_m, 2) + " m" : std::string("-"));
        any = any || coverage_m;
    }
    if (!any) return std::nullopt;
    return text + (facts.coverage_m.size() == 1 ? " to the nearest drone" : " to the nearest drone, part by part");
}

}  // namespace

std::string fixed(double value, int decimals) {
    std::array<char, 400> digits{};
    const auto end =
        std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::fixed, decimals).ptr;
    std::string text(digits.data(), end);
    const bool zero = text.find_first_not_of("-0.") == std::string::npos;
    return zero && text.starts_with('-') ? text.substr(1) : text;
}

FormationFacts facts_of(const planner::Mission& mission, std::size_t index, const planner::Formation& formation) {
    AEROGRAM_REQUIRE(index < mission.keyframes.size(), index, mission.keyframes.size());
    FormationFacts facts;
    facts.show = mission.name;
    facts.keyframe = mission.keyframes[index].name;
    facts.number = index + 1;
    facts.keyframes = mission.keyframes.size();
    facts.drones = formation.points_m.size();
    facts.spares = static_cast<std::size_t>(std::ranges::count(formation.spare, true));
    facts.downwash = mission.limits.downwash;
    facts.asked_spacing_m = mission.limits.formation_spacing_m;
    facts.coverage_m = formation.coverage_m;
    facts.note = formation.note;

    const SeparationMetric metric{mission.limits.downwash};
    if (facts.drones > 1) facts.closest = planner::closest_pair(formation.points_m, metric);
    const std::vector<double> nearest_m = nearest_distances(formation.points_m, metric);
    bool first = true;
    for (std::size_t i = 0; i < facts.drones; ++i) {
        if (formation.spare[i]) continue;
        const Vec3& p = formation.points_m[i];
        facts.low_m = first ? p : glm::min(facts.low_m, p);
        facts.high_m = first ? p : glm::max(facts.high_m, p);
        first = false;
        if (!nearest_m.empty()) facts.nearest_m.push_back(nearest_m[i]);
    }
    return facts;
}

std::vector<FactLine> fact_lines(const FormationFacts& facts) {
    std::vector<FactLine> lines;
    lines.push_back({"mission", facts.show});
    lines.push_back({"keyframe", facts.keyframe + " (" + std::to_string(facts.number) + " of " +
                                     std::to_string(facts.keyframes) + ")"});
    std::string drones = std::to_string(facts.drones);
    if (facts.spares > 0)
        drones += ", of which " + std::to_string(facts.spares) + (facts.spares == 1 ? " is" : " are") + " spare";
    lines.push_back({"drones", drones});
    lines.push_back({"smallest spacing", spacing_text(facts)});
    const Vec3 size_m = facts.high_m - facts.low_m;
    lines.push_back({"size", fixed(size_m.x, 1) + " x " + fixed(size_m.y, 1) + " x " + fixed(size_m.z, 1) +
                                 " m (width, depth, height)"});
    lines.push_back({"heights", "z = " + fixed(facts.low_m.z, 1) + " to " + fixed(facts.high_m.z, 1) + " m"});
    if (const auto coverage = coverage_text(facts)) lines.push_back({"coverage", *coverage});
    if (!facts.note.empty()) lines.push_back({"note", facts.note});
    return lines;
}

}  // namespace aerogram::exporter
