#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "export/report/parts.hpp"

namespace aerogram::exporter {
namespace {

struct Rule {
    std::string_view rule, title, unit;
    bool at_least;
};
/// In the order in which the report lists them; rules not known here follow under their own names.
constexpr std::array kRules{
    Rule{"separation", "Separation of any two drones", "m", true},
    Rule{"speed_horizontal", "Horizontal speed", "m/s", false},
    Rule{"speed_up", "Speed up", "m/s", false},
    Rule{"speed_down", "Speed down", "m/s", false},
    Rule{"airspeed_min", "Lowest airspeed", "m/s", true},
    Rule{"airspeed_max", "Highest airspeed", "m/s", false},
    Rule{"climb", "Climb", "m/s", false},
    Rule{"sink", "Sink", "m/s", false},
    Rule{"turn_rate_dps", "Turn rate", "°/s", false},
    Rule{"acceleration", "Acceleration", "m/s²", false},
    Rule{"velocity_jump", "Jump of the velocity", "m/s", false},
    Rule{"position_jump", "Jump of the position", "m", false},
    Rule{"altitude_max", "Highest altitude above own pad", "m", false},
    Rule{"altitude_min", "Lowest altitude above own pad", "m", true},
    Rule{"altitude_min_navigation", "Way sideways below the lowest altitude for it", "m", false},
    Rule{"geofence", "Margin inside the geofence", "m", true},
    Rule{"audience", "Margin beside the audience", "m", true},
    Rule{"obstacles", "Margin around obstacles", "m", true},
    Rule{"pads", "Distance from the own pad at start and end", "m", false},
    Rule{"endurance", "Length of the show within the endurance", "s", false},
};

/// The judgement numbers drones by their place in the file.
std::vector<std::size_t> numbers(const OutgoingShow& show, const std::vector<std::size_t>& places) {
    std::vector<std::size_t> all;
    for (const std::size_t p : places) {
        const bool here = p >= 1 && p <= show.drones();
        all.push_back(here ? show.facts().drones[p - 1].number : p);
    }
    return all;
}

ReportRule named(const Rule& known) {
    ReportRule rule;
    rule.rule = known.rule;
    rule.title = known.title;
    rule.unit = known.unit;
    rule.at_least = known.at_least;
    return rule;
}

ReportRule from(const OutgoingShow& show, const Finding& finding, const Rule& known) {
    ReportRule rule = named(known);
    rule.limit = finding.limit;
    rule.worst = finding.worst;
    rule.allowance = finding.allowance;
    rule.margin = known.at_least ? finding.worst - finding.limit : finding.limit - finding.worst;
    rule.drones = numbers(show, finding.drones);
    rule.time_s = finding.time_s;
    rule.held = finding.held;
    if (finding.time_s && !finding.drones.empty() && finding.drones[0] >= 1 && finding.drones[0] <= show.drones()) {
        const Flight flight = show.flight(finding.drones[0] - 1);
        rule.place_m = FlightCursor(flight).position_at(*finding.time_s);
    }
    return rule;
}

ReportRule reserve(const ReportEnergy& energy) {
    ReportRule rule = named({"reserve", "Share of the endurance left at landing (estimate)", "", true});
    rule.limit = energy.wanted_reserve;
    rule.worst = energy.least_reserve;
    rule.margin = energy.least_reserve - energy.wanted_reserve;
    if (energy.most_used_by > 0) rule.drones = {energy.most_used_by};
    rule.held = energy.held;
    return rule;
}

ReportRule flashes(const ReportLights& lights) {
    ReportRule rule = named({"flashes", "Flashes of the fleet's mean light in a second (WCAG 2.3.1)", "Hz", false});
    rule.limit = 3.0;
    rule.worst = lights.fleet_flash_hz;
    rule.margin = rule.limit - rule.worst;
    if (lights.fleet_flash_hz > 0.0) rule.time_s = lights.fleet_flash_s;
    rule.held = !lights.warning;
    return rule;
}

}  // namespace

void report_rules(const ReportInput& input, Report& report) {
    const std::vector<Finding>& findings = input.judgement.findings;
    for (const Rule& known : kRules) {
        for (const Finding& f : findings)
            if (f.rule == known.rule) report.rules.push_back(from(input.show, f, known));
    }
    for (const Finding& f : findings) {
        const bool known = std::ranges::any_of(kRules, [&](const Rule& k) { return k.rule == f.rule; });
        if (!known) report.rules.push_back(from(input.show, f, {f.rule, f.rule, "", false}));
    }
    report.rules.push_back(reserve(report.energy));
    report.rules.push_back(flashes(report.lights));
}

}  // namespace aerogram::exporter
