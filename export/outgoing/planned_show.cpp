#include "export/outgoing/planned_show.hpp"

#include <algorithm>
#include <numeric>

#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

using planner::Act, planner::ActRole, planner::FlightPlan;

std::vector<DroneId> everybody(const FlightPlan& plan) {
    std::vector<DroneId> drones;
    for (std::size_t i = 0; i < plan.drones(); ++i) drones.emplace_back(i);
    return drones;
}

/// Acts that begin at rest repeat their first control points.
bool begins_in_flight(const Act& act) {
    if (!std::holds_alternative<planner::Lattice>(act.motion)) return false;
    constexpr double kStill_m = 1e-6;
    for (std::size_t i = 0; i < drone_count(act.motion); ++i) {
        const Vec3 way = planner::control_point(act.motion, 2, i) - planner::control_point(act.motion, 0, i);
        if (glm::length(way) > kStill_m) return true;
    }
    return false;
}

void note_sections(OutgoingFacts& facts, const std::vector<Act>& acts) {
    const auto first = std::ranges::find_if(acts, [](const Act& a) { return a.role != ActRole::takeoff; });
    facts.takeoff_end_ms = first == acts.begin() ? 0 : std::prev(first)->end_ms();
    const auto last =
        std::find_if(acts.rbegin(), acts.rend(), [](const Act& a) { return a.role != ActRole::landing; }).base();
    facts.landing_begin_ms = last == acts.end() ? facts.duration_ms : last->start_ms;
}

OutgoingFacts facts_of(const FlightPlan& plan, std::span<const DroneId> drones) {
    OutgoingFacts facts;
    facts.title = plan.name;
    facts.fleet = plan.drones();
    for (const DroneId d : drones) {
        facts.drones.push_back({drone_name(d.number(), plan.drones()), d.number(), plan.pads_m[d.value],
                                plan.pads_m[d.value], plan.pad_of.empty() ? 0 : plan.pad_of[d.value].number()});
    }
    facts.origin = plan.origin;
    facts.limits = plan.limits;
    facts.airspace = plan.airspace;
    facts.endurance_s = plan.endurance_s;
    facts.duration_ms = plan.duration_ms();
    note_sections(facts, plan.acts);
    for (const planner::PlannedKeyframe& k : plan.keyframes) {
        facts.keyframes.push_back({k.name, k.stands_from_ms, k.stands_to_ms, {}});
        for (const DroneId d : drones)
            facts.keyframes.back().places_m.push_back(k.formation_m[k.slot_of[d.value].value]);
    }
    facts.cues = plan.cues;
    facts.audio = plan.audio;
    facts.acceleration_mps2 = plan.limits.acceleration_mps2;
    for (const planner::ActCertificate& act : plan.certificate.acts)
        facts.acceleration_mps2 = std::max(facts.acceleration_mps2, act.extremes.acceleration_mps2);
    facts.rides = std::ranges::any_of(plan.acts, begins_in_flight);
    facts.exporting = plan.exporting;
    facts.reporting = plan.reporting;
    return facts;
}

}  // namespace

PlannedShow::PlannedShow(const FlightPlan& plan) : PlannedShow(plan, everybody(plan)) {
}

PlannedShow::PlannedShow(const FlightPlan& plan, std::span<const DroneId> drones)
    : plan_(plan), facts_(facts_of(plan, drones)) {
    AEROGRAM_REQUIRE(!drones.empty());
    for (const Act& act : plan.acts) fitters_.emplace_back(act, plan.limits);
}

const Tracks& PlannedShow::tracks(std::size_t drone) const {
    static const Tracks kNone;
    return plan_.tracks.empty() ? kNone : plan_.tracks[id(drone).value];
}

Flight PlannedShow::flight(std::size_t drone) const {
    const std::size_t i = id(drone).value;
    Flight flight;
    const auto add = [&](double start_s, double duration_s, std::span<const Vec3> controls) {
        flight.pieces.push_back({start_s, duration_s, static_cast<std::uint32_t>(flight.controls_m.size()),
                                 static_cast<std::uint8_t>(controls.size() - 1)});
        flight.controls_m.insert(flight.controls_m.end(), controls.begin(), controls.end());
    };
    for (const Act& act : plan_.acts) {
        const double start_s = seconds_from_ms(act.start_ms);
        if (const auto* hold = std::get_if<planner::Hold>(&act.motion)) {
            add(start_s, seconds_from_ms(act.duration_ms), {&hold->positions_m[i], 1});
            continue;
        }
        const std::size_t intervals = planner::interval_count(act.motion);
        const double duration_s = seconds_from_ms(act.duration_ms), count = static_cast<double>(intervals);
        for (std::size_t m = 0; m < intervals; ++m) {
            const double from_s = start_s + duration_s * (static_cast<double>(m) / count);
            const double to_s = start_s + duration_s * (static_cast<double>(m + 1) / count);
            add(from_s, to_s - from_s, planner::bezier(act.motion, m, i));
        }
    }
    return flight;
}

Fitted PlannedShow::fitted(std::size_t drone) const {
    Fitted whole;
    for (const ActFitter& fitter : fitters_) {
        const Fitted act = fitter.fit(id(drone));
        whole.pieces.insert(whole.pieces.end(), act.pieces.begin(), act.pieces.end());
        whole.error.position_m = std::max(whole.error.position_m, act.error.position_m);
        whole.error.speed_mps = std::max(whole.error.speed_mps, act.error.speed_mps);
        whole.error.acceleration_mps2 = std::max(whole.error.acceleration_mps2, act.error.acceleration_mps2);
    }
    return whole;
}

const planner::FlightPlan* PlannedShow::whole_plan() const {
    return drones() == plan_.drones() ? &plan_ : nullptr;
}

}  // namespace aerogram::exporter
