#include <algorithm>
#include <iostream>
#include <limits>
#include <sstream>

#include "export/export_papers.hpp"
#include "export/export_show.hpp"
#include "geo/units.hpp"
#include "ground/app/answers.hpp"
#include "ground/app/commands.hpp"
#include "ground/app/exit_status.hpp"
#include "ground/app/wishes.hpp"
#include "ground/app/words.hpp"
#include "planner/mission/mission_reader.hpp"
#include "planner/mission/sections.hpp"
#include "planner/plan.hpp"
#include "planner/replace.hpp"

namespace aerogram::ground {
namespace {

using planner::ActCertificate;
using planner::Certificate;
using planner::FlightPlan;

const ActCertificate& closest_act(const Certificate& certificate) {
    return *std::min_element(certificate.acts.begin(), certificate.acts.end(), [](const auto& a, const auto& b) {
        return a.separation.lower_bound_m < b.separation.lower_bound_m;
    });
}

std::string separation_line(const FlightPlan& plan) {
    const double required_m = planned_separation_m(plan.limits);
    if (plan.drones() < 2) return "separation     one drone: nothing to keep apart\n";
    const ActCertificate& act = closest_act(plan.certificate);
    std::string line = "separation     >= " + decimals(act.separation.lower_bound_m, 3) +
                       " m at every instant (required " + decimals(required_m, 2) + ")";
    if (act.separation.closest) {
        const auto& e = *act.separation.closest;
        line += ", closest: drones " + std::to_string(e.first.number()) + " and " + std::to_string(e.second.number()) +
                " at " + decimals(seconds_from_ms(act.start_ms) + e.time_s, 2) + " s, " + act.name;
    }
    return line + "\n";
}

std::string plane_line(const FlightPlan& plan, const PlaneLimits& l) {
    double slowest_mps = std::numeric_limits<double>::infinity(), fastest_mps = 0.0, turn_dps = 0.0;
    for (const ActCertificate& act : plan.certificate.acts) {
        if (!act.plane) continue;
        slowest_mps = std::min(slowest_mps, act.plane->airspeed_min_mps.value);
        fastest_mps = std::max(fastest_mps, act.plane->airspeed_max_mps.value);
        turn_dps = std::max(turn_dps, act.plane->turn_rate_dps.value);
    }
    return "airspeeds      " + decimals(slowest_mps, 2) + " to " + decimals(fastest_mps, 2) + " m/s (limits " +
           decimals(l.airspeed_min_mps, 2) + " to " + decimals(l.airspeed_max_mps, 2) + "), turns " +
           decimals(turn_dps, 2) + " of " + decimals(l.turn_rate_dps, 2) + " degrees a second\n";
}

std::string limits_lines(const FlightPlan& plan) {
    planner::Extremes most;
    double highest_m = 0.0;
    std::optional<double> fence_m;
    for (const ActCertificate& act : plan.certificate.acts) {
        const planner::Extremes& e = act.extremes;
        most.speed_horizontal_mps = std::max(most.speed_horizontal_mps, e.speed_horizontal_mps);
        most.speed_up_mps = std::max(most.speed_up_mps, e.speed_up_mps);
        most.speed_down_mps = std::max(most.speed_down_mps, e.speed_down_mps);
        most.acceleration_mps2 = std::max(most.acceleration_mps2, e.acceleration_mps2);
        most.jerk_mps3 = std::max(most.jerk_mps3, e.jerk_mps3);
        highest_m = std::max(highest_m, act.altitude_max_m);
        if (act.geofence_margin_m) fence_m = std::min(fence_m.value_or(*act.geofence_margin_m), *act.geofence_margin_m);
    }
    const Limits& l = plan.limits;
    const auto of = [](double value, double limit) { return decimals(value, 2) + " of " + decimals(limit, 2); };
    const std::string speeds =
        l.plane ? plane_line(plan, *l.plane) + "speeds         up " + of(most.speed_up_mps, l.plane->climb_mps) +
                      ", down " + of(most.speed_down_mps, l.plane->sink_mps) + " m/s\n"
                : "speeds         horizontal " + of(most.speed_horizontal_mps, l.speed_horizontal_mps) + ", up " +
                      of(most.speed_up_mps, l.speed_up_mps) + ", down " + of(most.speed_down_mps, l.speed_down_mps) +
                      " m/s\n";
    return speeds + "acceleration   " + of(most.acceleration_mps2, l.acceleration_mps2) + " m/s², jerk " +
           of(most.jerk_mps3, l.jerk_mps3) + " m/s³\n" + "altitude       up to " + of(highest_m, l.ceiling_m) + " m" +
           (fence_m ? ", " + decimals(*fence_m, 1) + " m inside the geofence" : std::string()) + "\n";
}

/// Why `auto` flies as it does, a line an act.
std::string choice_lines(const FlightPlan& plan) {
    std::string lines;
    for (const ActCertificate& act : plan.certificate.acts) {
        if (!act.chosen_because.empty())
            lines += "chosen         " + act.name + ", " + act.method + ": " + act.chosen_because + "\n";
    }
    return lines;
}

std::string summary(const FlightPlan& plan, const exporter::ExportedShow& shown, const std::filesystem::path& out) {
    std::ostringstream text;
    text << plan.name << ": " << counted(plan.drones(), "drone") << ", " << counted(plan.keyframes.size(), "keyframe")
         << ", " << decimals(seconds_from_ms(plan.duration_ms()), 1) << " s\n";
    text << (shown.certified ? "certified      every act holds every limit in continuous time\n"
                             : "NOT CERTIFIED  do not fly; see certificate.json\n");
    text << separation_line(plan) << limits_lines(plan) << choice_lines(plan);
    std::string written, skipped, why;
    for (const auto& format : shown.formats) {
        if (format.skipped.empty()) {
            written += " " + format.name;
        } else {
            why = skipped.empty() ? format.skipped : "manifest.json says why";
            skipped += (skipped.empty() ? "" : ", ") + format.name;
        }
    }
    text << "formats       " << written << "\n";
    if (!skipped.empty()) text << "left out       " << skipped << ": " << why << "\n";
    text << "show hash      " << shown.show_hash << "\n";
    text << "written to     " << out.string() << "\n";
    std::string pages;
    for (const char* page : {"preview.html", "report.html"}) {
        std::error_code failure;
        if (std::filesystem::exists(out / page, failure))
            pages +=
                (pages.empty() ? "" : " and ") + (pages.empty() ? out / page : std::filesystem::path(page)).string();
    }
    if (!pages.empty()) text << "look at        " << pages << "  (any browser, no network needed)\n";
    return text.str();
}

void tell_violations(const FlightPlan& plan, Console& console) {
    for (const std::string& violation : plan.certificate.violations) console.error("not certified: " + violation);
    for (const ActCertificate& act : plan.certificate.acts) {
        for (const std::string& violation : act.violations) console.error("not certified: " + violation);
    }
}

/// The mission with what was typed in the place of its [export].
Result<planner::Mission> mission_of(const PlanCommand& command) {
    if (const Status known = check_format_names(command.formats); !known) return known.error();
    planner::ExportWishes wishes;
    const TypedWishes typed{command.start_utc, command.timing, command.autopilot, command.vviz};
    if (const Status sound = take_wishes(typed, wishes); !sound) return sound.error();
    auto mission = planner::read_mission(command.mission);
    if (mission) static_cast<void>(take_wishes(typed, mission->exporting));
    if (mission && command.timing == "absolute" && !mission->exporting.start_utc_s)
        return Error{ErrorCode::invalid_input, "--timing absolute needs --start-utc, or start_utc in [export]"};
    return mission;
}

Result<std::vector<DroneId>> drones_of(const PlanCommand& command, const planner::Mission& mission) {
    if (command.drones.empty()) return std::vector<DroneId>{};
    auto drones = planner::parse_drone_list(command.drones, mission.fleet.drones);
    if (!drones) return Error{drones.error().code, "--drones " + command.drones + ": " + drones.error().message};
    return drones;
}

Result<std::vector<planner::Replacement>> replacements_of(const PlanCommand& command) {
    std::vector<planner::Replacement> replacements;
    for (const std::string& text : command.replace) {
        const auto replacement = planner::parse_replacement(text);
        if (!replacement) return Error{replacement.error().code, "--replace " + replacement.error().message};
        replacements.push_back(*replacement);
    }
    return replacements;
}

/// Why a plan cannot be flown, and where its report is.
Error refusal_of(const planner::Mission& mission, const FlightPlan& plan, const std::filesystem::path& out,
                 const Run& run) {
    Error refusal = planner::refusal(mission, plan.certificate);
    const Status told = exporter::write_refused_report(plan, out, exporter::reasons_of(plan), {}, run);
    if (!told) return told.error();
    refusal.message += "\n  " + exporter::refused_words(out);
    return refusal;
}

/// The certified plan, or with --best-effort any; with spare drones in the place of others. Of a plan that is refused
/// a report is left beside `out`.
Result<FlightPlan> plan_of(const planner::Mission& mission, const PlanCommand& command,
                           const std::vector<planner::Replacement>& replacements, const std::filesystem::path& out,
                           const Run& run) {
    auto plan = planner::plan(mission, {.best_effort = true}, run);
    if (!plan) return plan;
    if (!plan->certificate.certified() && !command.best_effort) return refusal_of(mission, *plan, out, run);
    if (replacements.empty()) return plan;
    auto changed = planner::replaced(std::move(*plan), replacements, run);
    if (!changed && changed.error().code != ErrorCode::stopped)
        return Error{changed.error().code, "--replace " + changed.error().message};
    return changed;
}

}  // namespace

int run_plan(const PlanCommand& command, const Session& session) {
    const auto out = command.out.empty() ? std::filesystem::path("out") / command.mission.stem() : command.out;
    const auto mission = mission_of(command);
    if (!mission) return report_error(mission.error(), session);
    const auto drones = drones_of(command, *mission);
    if (!drones) return report_error(drones.error(), session);
    const auto replacements = replacements_of(command);
    if (!replacements) return report_error(replacements.error(), session);
    const auto plan = plan_of(*mission, command, *replacements, out, session.run);
    if (!plan) return report_error(plan.error(), session);
    const auto shown = exporter::export_show(
        *plan, out, {.formats = command.formats, .best_effort = command.best_effort, .drones = *drones}, session.run);
    if (!shown) return report_error(shown.error(), session);
    session.console.clear_line();
    if (!shown->certified) tell_violations(*plan, session.console);
    for (const std::string& line : shown->broken) session.console.error("not certified: " + line);
    for (const std::string& warning : shown->warnings) session.console.error("warning: " + warning);
    if (session.json) {
        std::cout << plan_answer(*plan, *shown, out);
    } else if (!session.quiet) {
        std::cout << summary(*plan, *shown, out);
        if (!drones->empty()) std::cout << "only           " << counted(drones->size(), "drone") << " of these\n";
        for (const auto& [drone, pad] : *replacements)
            std::cout << "replaced       drone " << drone.number() << " flies from pad " << pad.number() << "\n";
    }
    return shown->certified ? kDone : kCannotBeFlown;
}

}  // namespace aerogram::ground
