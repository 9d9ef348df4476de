#include "planner/plan.hpp"

#include <algorithm>
#include <iomanip>
#include <optional>
#include <span>
#include <sstream>

#include "geo/units.hpp"
#include "planner/carrier/noses.hpp"
#include "planner/gather.hpp"
#include "planner/leg.hpp"
#include "planner/leg_motion.hpp"
#include "planner/light/lights.hpp"
#include "planner/retrace.hpp"
#include "planner/riding.hpp"
#include "planner/route.hpp"
#include "planner/timeline.hpp"

namespace aerogram::planner {
namespace {

Result<std::vector<LegMotion>> plan_legs(const Mission& mission, const Route& route, const std::vector<Leg>& legs,
                                         const Run& run) {
    const Run quiet{run.stop, nullptr, 1};
    return gather<LegMotion>(legs.size(), run, "transitions",
                             [&](std::size_t l) { return plan_leg(mission, route, legs[l], quiet); });
}

/// @param asked_m  what each act must keep; as many as acts.
Result<Certificate> certify_acts(const Mission& mission, const std::vector<Act>& acts,
                                 const std::vector<double>& asked_m, const Run& run) {
    const Surroundings surroundings{geo::ShowFrame(mission.origin), mission.airspace, mission.fleet.pads_m,
                                    mission.limits};
    const Run quiet{run.stop, nullptr, 1};
    auto certificates = gather<ActCertificate>(acts.size(), run, "certificate", [&](std::size_t a) {
        return certify(acts[a], surroundings, quiet, asked_m[a]);
    });
    if (!certificates) return certificates.error();
    Certificate certificate{std::move(*certificates), {}};
    const double total_s = seconds_from_ms(acts.back().end_ms());
    if (total_s > mission.fleet.endurance_s) {
        std::ostringstream text;
        text << std::setprecision(6) << "the show lasts " << total_s
             << " s, longer than endurance_s = " << mission.fleet.endurance_s;
        certificate.violations.push_back(text.str());
    }
    return certificate;
}

void tell_how(Certificate& certificate, const Timeline& timeline, const std::vector<Leg>& legs,
              const std::vector<LegReport>& reports) {
    for (std::size_t a = 0; a < certificate.acts.size(); ++a) {
        ActCertificate& act = certificate.acts[a];
        act.method = "hold";
        if (!timeline.leg_of[a]) continue;
        const LegReport& report = reports[*timeline.leg_of[a]];
        act.method = report.method;
        act.chosen_because = report.chosen_because;
        act.separation_by = report.separation_by;
        act.separation_rounds = report.separation_rounds;
        act.path_ratio = report.path_ratio;
        act.assignment = legs[*timeline.leg_of[a]].assignment;
        if (report.swapped > 0)
            act.assignment += "; then " + std::to_string(report.swapped) + " drones took each other's places";
    }
}

/// Drones that took each other's targets on a leg go on as each other.
void exchange_from(Route& route, std::size_t keyframe, std::span<const std::uint32_t> target_of) {
    for (std::size_t k = keyframe; k < route.stops.size(); ++k) {
        const Stop before = route.stops[k];
        for (std::size_t d = 0; d < target_of.size(); ++d) {
            route.stops[k].keyframe.slot_of[d] = before.keyframe.slot_of[target_of[d]];
            route.stops[k].by_drone_m[d] = before.by_drone_m[target_of[d]];
            route.stops[k].left_from_m[d] = before.left_from_m[target_of[d]];
            route.stops[k].still[d] = before.still[target_of[d]];
        }
    }
}

/// Plans all legs; where drones had to swap targets, the legs after that once more.
Result<std::vector<LegMotion>> plan_legs_with_swaps(const Mission& mission, Route& route, std::vector<Leg>& legs,
                                                    const Run& run) {
    auto motions = plan_legs(mission, route, legs, run);
    if (!motions) return motions.error();
    for (std::size_t l = 0; l < legs.size(); ++l) {
        if ((*motions)[l].target_of.empty()) continue;
        exchange_from(route, legs[l].last, (*motions)[l].target_of);
        legs = legs_of(mission, route);
        const std::vector<Leg> later(legs.begin() + static_cast<std::ptrdiff_t>(l) + 1, legs.end());
        auto again = plan_legs(mission, route, later, run);
        if (!again) return again.error();
        std::ranges::move(*again, motions->begin() + static_cast<std::ptrdiff_t>(l) + 1);
    }
    return motions;
}

/// Whether a way home, flown in its shortest time, holds every limit.
Result<bool> is_safe(const Mission& mission, const Leg& leg, const LegMotion& motion, const Run& run) {
    const Millis duration_ms = std::max<Millis>(1, motion.shortest.duration_ms);
    const Run quiet{run.stop, nullptr, run.threads};
    auto judged = certify_acts(mission, {{leg.name, leg.role, Timing::free, 0, duration_ms, motion.motion}},
                               {motion.report.required_separation_m}, quiet);
    if (!judged) return judged.error();
    return judged->acts.front().certified();
}

/// Where drones would come too close on their way home from the last formation: the way out backwards, if that is safe.
Status go_home_safely(const Mission& mission, const Route& route, std::vector<Leg>& legs,
                      std::vector<LegMotion>& motions, const Run& run) {
    const auto home =
        std::ranges::find_if(legs, [](const Leg& leg) { return !leg.arrives && leg.role == ActRole::transit; });
    const auto at = home - legs.begin();
    auto safe = is_safe(mission, *home, motions[static_cast<std::size_t>(at)], run);
    if (!safe || *safe) return safe ? Status(Done{}) : safe.error();
    Ways back = retrace(mission, route, legs, motions);
    for (std::size_t w = 0; w < back.legs.size(); ++w) {
        safe = is_safe(mission, back.legs[w], back.motions[w], run);
        if (!safe || !*safe) return safe ? Status(Done{}) : safe.error();
    }
    legs.insert(legs.erase(home), back.legs.begin(), back.legs.end());
    motions.insert(motions.erase(motions.begin() + at), std::make_move_iterator(back.motions.begin()),
                   std::make_move_iterator(back.motions.end()));
    return Done{};
}

/// A show on one place: legs and holds on one clock.
Result<Flown> plan_standing(const Mission& mission, const Run& run) {
    auto route = build_route(mission, run);
    if (!route) return route.error();
    Flown flown{legs_of(mission, *route), {}, {}, route->groups};
    auto motions = plan_legs_with_swaps(mission, *route, flown.legs, run);
    if (!motions) return motions.error();
    if (auto done = go_home_safely(mission, *route, flown.legs, *motions, run); !done) return done.error();
    for (const LegMotion& motion : *motions) flown.reports.push_back(motion.report);
    auto timeline = build_timeline(mission, *route, flown.legs, std::move(*motions));
    if (!timeline) return timeline.error();
    flown.timeline = std::move(*timeline);
    return flown;
}

}  // namespace

Error refusal(const Mission& mission, const Certificate& certificate) {
    std::string message = mission.file.string() + ": this show cannot be flown within its limits";
    for (const std::string& violation : certificate.violations) message += "\n  " + violation;
    bool obstructed = false;
    for (const ActCertificate& act : certificate.acts) {
        for (const std::string& violation : act.violations) message += "\n  " + violation;
        obstructed |= act.method != "steered" && act.obstacle_margin_m.value_or(0.0) < 0.0;
    }
    if (obstructed) message += "\n  (arrive.method = \"steered\" leads groups around obstacles)";
    return {ErrorCode::infeasible, message};
}

Result<FlightPlan> plan(const Mission& mission, const PlanOptions& options, const Run& run) {
    auto flown = mission.carrier ? plan_riding(mission, run) : plan_standing(mission, run);
    if (!flown) return flown.error();
    Timeline& timeline = flown->timeline;
    std::vector<double> asked_m;
    for (const auto& leg : timeline.leg_of)
        asked_m.push_back(leg ? flown->reports[*leg].required_separation_m : planned_separation_m(mission.limits));
    auto certificate = certify_acts(mission, timeline.acts, asked_m, run);
    if (!certificate) return certificate.error();
    tell_how(*certificate, timeline, flown->legs, flown->reports);
    if (!certificate->certified() && !options.best_effort) return refusal(mission, *certificate);

    FlightPlan plan;
    plan.name = mission.name;
    plan.origin = mission.origin;
    plan.limits = mission.limits;
    plan.airspace = mission.airspace;
    plan.endurance_s = mission.fleet.endurance_s;
    plan.pads_m = mission.fleet.pads_m;
    auto tracks = lit_tracks(mission, {timeline.keyframes, timeline.acts, flown->groups},
                             build_tracks(timeline.keyframes, timeline.acts, mission.fleet.drones), run);
    if (!tracks) return tracks.error();
    plan.tracks = std::move(*tracks);
    if (mission.fleet.vehicle == Vehicle::plane) {
        for (std::size_t d = 0; d < plan.tracks.size(); ++d)
            plan.tracks[d].yaw = noses_forward(timeline.acts, DroneId(d));
    }
    plan.acts = std::move(timeline.acts);
    plan.keyframes = std::move(timeline.keyframes);
    plan.cues = mission.cues;
    plan.audio = mission.audio;
    plan.spare_pads_m = mission.fleet.spare_pads_m;
    plan.exporting = mission.exporting;
    plan.reporting = mission.reporting;
    plan.certificate = std::move(*certificate);
    return plan;
}

}  // namespace aerogram::planner
