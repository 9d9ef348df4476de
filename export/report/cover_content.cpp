#include <algorithm>
#include <cmath>

#include "export/report/report_content.hpp"
#include "export/report/report_words.hpp"

namespace aerogram::exporter {
namespace {

const ReportRule* rule_named(const Report& report, const char* name) {
    const auto found = std::find_if(report.rules.begin(), report.rules.end(),
                                    [&](const ReportRule& rule) { return rule.rule == name; });
    return found == report.rules.end() ? nullptr : &*found;
}

std::string who_and_when(const ReportRule& rule) {
    std::string text;
    if (!rule.drones.empty()) text = (rule.drones.size() == 1 ? "drone " : "drones ") + drones_text(rule.drones);
    if (rule.time_s) text += (text.empty() ? "at " : " at ") + clock_text(*rule.time_s);
    return text;
}

std::string with_unit(double value, int digits, const std::string& unit) {
    return fixed_text(value, digits) + " " + unit;
}

Figure rule_figure(const ReportRule* rule, const std::string& name) {
    if (rule == nullptr) return {name, kAbsent, "not judged"};
    const int digits = rule_digits(*rule);
    const std::string limit = "limit " + with_unit(rule->limit, digits, rule->unit), who = who_and_when(*rule);
    return {name, with_unit(rule->worst, digits, rule->unit), who.empty() ? limit : limit + "; " + who};
}

/// The rule whose margin is the smallest share of its limit; a broken one before all that hold.
const ReportRule* tightest(const Report& report) {
    const auto share = [](const ReportRule& rule) { return rule.margin / std::max(std::abs(rule.limit), 1e-3); };
    const ReportRule* found = nullptr;
    for (const ReportRule& rule : report.rules) {
        const bool zero_limit = rule.held && rule.limit == 0.0;
        if (zero_limit || !std::isfinite(rule.margin)) continue;
        if (found == nullptr || (found->held && !rule.held) ||
            (found->held == rule.held && share(rule) < share(*found)))
            found = &rule;
    }
    return found;
}

/// The nearest of what stands around the show; of a failing show, and where nothing does, the tightest rule.
Figure margin_figure(const Report& report) {
    const ReportRule* rule = nullptr;
    for (const char* name : {"geofence", "audience", "obstacles"}) {
        const ReportRule* around = rule_named(report, name);
        if (around != nullptr && (rule == nullptr || around->margin < rule->margin)) rule = around;
    }
    const bool around = rule != nullptr && report.certified;
    if (!around) rule = tightest(report);
    if (rule == nullptr) return {"Tightest margin", kAbsent, "no rule judged"};
    const std::string who = who_and_when(*rule);
    return {around ? "Least margin to what stands around" : "Tightest margin",
            signed_text(rule->margin, rule_digits(*rule)) + " " + rule->unit,
            rule->title + (who.empty() ? "" : "; " + who)};
}

std::vector<Figure> figures_of(const Report& report) {
    std::vector<Figure> figures;
    const ReportRule* separation = rule_named(report, "separation");
    Figure smallest = rule_figure(separation, "Smallest separation");
    if (separation != nullptr) smallest.value = with_unit(report.min_separation_m, rule_digits(*separation), "m");
    figures.push_back(smallest);
    figures.push_back(margin_figure(report));
    figures.push_back(rule_figure(rule_named(report, "altitude_max"), "Highest altitude"));
    const ReportRule* speed = rule_named(report, "speed_horizontal");
    figures.push_back(rule_figure(speed != nullptr ? speed : rule_named(report, "airspeed_max"),
                                  speed != nullptr ? "Highest horizontal speed" : "Highest airspeed"));
    figures.push_back({"Least energy reserve", percent_text(report.energy.least_reserve, 1),
                       "wanted " + percent_text(report.energy.wanted_reserve, 0) + "; drone " +
                           std::to_string(report.energy.most_used_by)});
    figures.push_back({"Maximum wind", with_unit(report.wind_mps, 1, "m/s"),
                       with_unit(report.wind_mps * 3.6, 0, "km/h") + "; do not fly in more"});
    return figures;
}

std::vector<Fact> limits_of(const Report& report) {
    const Limits& l = report.limits;
    std::vector<Fact> facts{{"Separation", "≥ " + with_unit(l.min_separation_m, 2, "m")},
                            {"Downwash factor", fixed_text(l.downwash, 2)}};
    if (l.plane) {
        facts.push_back({"Airspeed", fixed_text(l.plane->airspeed_min_mps, 1) + " to " +
                                         with_unit(l.plane->airspeed_max_mps, 1, "m/s")});
        facts.push_back(
            {"Climb, sink", "≤ " + fixed_text(l.plane->climb_mps, 1) + ", " + with_unit(l.plane->sink_mps, 1, "m/s")});
        facts.push_back({"Turn rate", "≤ " + with_unit(l.plane->turn_rate_dps, 1, "°/s")});
    } else {
        facts.push_back({"Speed, horizontal", "≤ " + with_unit(l.speed_horizontal_mps, 2, "m/s")});
        facts.push_back({"Speed, up", "≤ " + with_unit(l.speed_up_mps, 2, "m/s")});
        facts.push_back({"Speed, down", "≤ " + with_unit(l.speed_down_mps, 2, "m/s")});
    }
    facts.push_back({"Acceleration", "≤ " + with_unit(l.acceleration_mps2, 2, "m/s²")});
    facts.push_back({"Jerk", "≤ " + with_unit(l.jerk_mps3, 2, "m/s³")});
    facts.push_back({"Ceiling", "≤ " + with_unit(l.ceiling_m, 1, "m")});
    facts.push_back({"Sideways from", with_unit(l.min_navigation_altitude_m, 1, "m up")});
    return facts;
}

std::vector<Fact> facts_of(const Report& report) {
    std::vector<Fact> facts;
    facts.push_back({"Drones", count_text(report.drones)});
    facts.push_back({"Duration", clock_text(report.duration_s) + " min:s"});
    facts.push_back({"Endurance", clock_text(report.endurance_s) + " min:s"});
    if (report.origin) {
        const geo::ShowOrigin& origin = *report.origin;
        facts.push_back({"Place", origin_text(origin)});
        facts.push_back({"Heading", fixed_text(origin.heading_deg, 2) + "° from true north"});
        std::string height = with_unit(origin.ground.height_m, 1, "m above the ellipsoid");
        if (origin.geoid_undulation_m)
            height +=
                ", " + with_unit(origin.ground.height_m - *origin.geoid_undulation_m, 1, "m above mean sea level");
        facts.push_back({"Ground", height});
    } else {
        facts.push_back({"Place", "none: the show is not placed on the globe"});
    }
    facts.push_back({"Profile", report.profile});
    facts.push_back({"Planned with", report.program + " " + report.version});
    return facts;
}

/// The closest approach of each emergency at its worst second.
std::string emergencies_text(const Report& report) {
    if (report.emergencies.empty())
        return report.limits.plane ? "not computed: planes cannot hold their place" : "none computed";
    const auto closest = [&](ReportApproach ReportEmergency::*which) {
        std::optional<double> least_m;
        for (const ReportEmergency& e : report.emergencies) {
            if ((e.*which).distance_m)
                least_m = std::min(least_m.value_or(*(e.*which).distance_m), *(e.*which).distance_m);
        }
        return least_m ? with_unit(*least_m, 2, "m") : std::string("–");
    };
    return "closest at the worst second: one holds " + closest(&ReportEmergency::one_holds) + ", lands " +
           closest(&ReportEmergency::one_lands) + ", returns " + closest(&ReportEmergency::one_returns) +
           "; all hold " + closest(&ReportEmergency::all_hold) + ", land " + closest(&ReportEmergency::all_land) +
           ", return " + closest(&ReportEmergency::all_return);
}

std::string held_text(std::size_t held, std::size_t of) {
    return count_text(held) + " of " + count_text(of) + " held";
}

std::vector<Fact> findings_of(const Report& report) {
    const auto held = [](const auto& list) {
        return held_text(static_cast<std::size_t>(
                             std::count_if(list.begin(), list.end(), [](const auto& entry) { return entry.held; })),
                         list.size());
    };
    std::vector<ReportFormat> written;
    for (const ReportFormat& f : report.formats)
        if (f.skipped.empty()) written.push_back(f);
    const std::size_t skipped = report.formats.size() - written.size();
    const geo::Airspace& around = report.airspace;
    const bool nothing_around = around.geofence_m.empty() && around.audience_m.empty() && around.obstacles.empty();
    return {{"Rules", held(report.rules)},
            {"Exported formats", held(written) + (skipped > 0 ? ", " + count_text(skipped) + " not written" : "")},
            {"Energy", report.energy.held ? "the reserve is kept by every drone" : "the reserve is NOT kept"},
            {"Emergencies", emergencies_text(report)},
            {"Heading or origin wrong", nothing_around ? "nothing to hold: no fence, audience or obstacle is stated"
                                                       : held(report.sensitivities) + " (up to ±7° and ±5 m)"},
            {"Lights",
             report.lights.warning ? "WARNING: flashes more than three times a second" : "no flash-rate warning"}};
}

}  // namespace

/// Which files a certificate does not speak of.
std::string not_covered(const Report& report) {
    std::string names;
    for (const ReportFormat& format : report.formats) {
        if (report.drones > 1 && format.skipped.empty() && !format.min_separation_m)
            names += (names.empty() ? "" : ", ") + format.name;
    }
    return names.empty() ? names
                         : " No separation is claimed for vehicles that fly the waypoint files (" + names + ").";
}

Cover cover_of(const Report& report) {
    Cover cover;
    cover.title = report.title;
    cover.certified = report.certified;
    const bool warned = !report.warnings.empty();
    cover.verdict = !report.certified ? "NOT CERTIFIED – DO NOT FLY"
                    : warned          ? "CERTIFIED, WITH WARNINGS"
                                      : "CERTIFIED";
    cover.reasons = report.certified ? std::vector<std::string>{} : report.reasons;
    for (const std::string& warning : report.warnings) cover.reasons.push_back("Warning: " + warning);
    if (!report.certified && cover.reasons.empty()) cover.reasons.emplace_back("no reason was given");
    cover.statement =
        report.certified
            ? "Every limit of flight holds for every drone at every instant. This is said of the files of the show "
              "with the hash below, placed and flown as stated, and of no others." +
                  not_covered(report)
            : std::string("This show must not be flown. The numbers below are what was found.");
    for (std::size_t at = 0; at < report.show_hash.size(); at += 32)
        cover.hash.push_back(grouped_hash(report.show_hash, at, at + 32));
    if (cover.hash.empty()) cover.hash.emplace_back("none");
    cover.figures = figures_of(report);
    cover.facts = facts_of(report);
    cover.limits = limits_of(report);
    cover.findings = findings_of(report);
    if (report.certified) cover.signing = {"Pilot in command", "Signature", "Date", "Place"};
    return cover;
}

}  // namespace aerogram::exporter
