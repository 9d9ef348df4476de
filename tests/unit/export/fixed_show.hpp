#pragma once
#include <cstddef>
#include <utility>
#include <vector>

#include "planner/motion/flight_plan.hpp"

/// A small show written by hand for tests of writers and readers: three drones, one act of every kind and role, nothing
/// symmetric, so that swapped axes, drones or acts cannot go unnoticed. Only + - * / are used: the same bits
/// everywhere. It holds the default limits.
namespace aerogram::exporter::fixed {

/// Minimum-jerk profile as spline rows: first three 0, last three 1.
inline std::vector<double> profile(std::size_t rows) {
    std::vector<double> s(rows, 1.0);
    for (std::size_t k = 0; k + 3 < rows; ++k) {
        const double u = k < 3 ? 0.0 : static_cast<double>(k - 1) / static_cast<double>(rows - 3);
        s[k] = u * u * u * (10.0 + u * (-15.0 + 6.0 * u));
    }
    return s;
}

inline Points pads() {
    return {{0.0, -20.0, 0.0}, {2.5, -20.25, 0.0}, {6.0, -19.0, 0.125}};
}
inline Points above_pads() {
    return {{0.0, -20.0, 5.0}, {2.5, -20.25, 5.5}, {6.0, -19.0, 6.125}};
}
inline Points formation_a() {
    return {{-4.0, 0.0, 12.0}, {1.0, 2.0, 15.5}, {5.25, -1.0, 19.0}};
}
inline Points formation_b() {
    return {{-7.0, 3.0, 14.0}, {2.0, -4.0, 11.0}, {9.5, 1.0, 21.0}};
}

/// From A to B with a different bulge for every drone.
inline planner::Lattice bulging_lattice() {
    constexpr std::size_t kRows = 15;
    const Points from = formation_a(), to = formation_b();
    const Points bulge{{1.0, -0.5, 0.75}, {-0.25, 1.5, 0.5}, {0.5, 1.0, -1.25}};
    const std::vector<double> s = profile(kRows);
    planner::Lattice lattice{3, {}};
    for (std::size_t k = 0; k < kRows; ++k) {
        const double b = 16.0 * s[k] * s[k] * (1.0 - s[k]) * (1.0 - s[k]);
        for (std::size_t i = 0; i < 3; ++i)
            lattice.points_m.push_back(from[i] + s[k] * (to[i] - from[i]) + b * bulge[i]);
    }
    return lattice;
}

inline std::vector<planner::Act> acts() {
    using planner::ActRole, planner::Timing, planner::Straight, planner::Hold;
    std::vector<planner::Act> acts;
    const auto add = [&](const char* name, ActRole role, Timing timing, Millis duration_ms, planner::Motion motion) {
        const Millis start_ms = acts.empty() ? 0 : acts.back().end_ms();
        acts.push_back({name, role, timing, start_ms, duration_ms, std::move(motion)});
    };
    add("take-off", ActRole::takeoff, Timing::free, 8'000, Straight{pads(), above_pads(), profile(11)});
    add("to A", ActRole::transit, Timing::free, 16'000, Straight{above_pads(), formation_a(), profile(19)});
    add("A", ActRole::hold, Timing::free, 3'000, Hold{formation_a()});
    add("to B", ActRole::transit, Timing::fixed, 9'600, bulging_lattice());
    add("B", ActRole::hold, Timing::free, 4'000, Hold{formation_b()});
    add("return", ActRole::transit, Timing::free, 20'000, Straight{formation_b(), above_pads(), profile(23)});
    add("landing", ActRole::landing, Timing::free, 10'000, Straight{above_pads(), pads(), profile(13)});
    return acts;
}

inline std::vector<Tracks> tracks() {
    std::vector<Tracks> tracks(3);
    tracks[0].lights = {
        {0, {0.0, 0.0, 0.0}, false}, {24'000, {1.0, 0.5, 0.0}, true}, {27'000, {0.0, 0.25, 1.0}, false}};
    tracks[1].lights = {
        {20, {0.125, 0.0, 0.0}, false}, {24'020, {0.0, 1.0, 0.5}, false}, {60'000, {0.0, 0.0, 0.0}, false}};
    tracks[2].lights = {{24'000, {0.75, 0.75, 0.25}, true}, {36'600, {0.0, 0.0, 1.0}, false}};
    tracks[1].yaw = {{8'000, 0.0}, {24'000, 1.5}, {36'600, -0.75}};
    tracks[2].events = {{27'500, 2, true}, {29'500, 2, false}};
    return tracks;
}

inline geo::Airspace airspace() {
    geo::Airspace air;
    air.geofence_m = {{-60.0, -35.0}, {70.0, -40.0}, {65.0, 50.0}, {0.0, 62.0}, {-55.0, 45.0}};
    air.audience_m = {{{-30.0, -80.0}, {30.0, -80.0}, {25.0, -45.0}, {-25.0, -45.0}}};
    air.obstacles = {{"mast", geo::Cylinder{{30.0, 10.0}, 4.0}, 0.0, 25.0},
                     {"stage", geo::Prism{{{-20.0, -34.0}, {-10.0, -34.0}, {-12.0, -28.0}}}, 0.5, 6.0}};
    return air;
}

inline std::vector<planner::PlannedKeyframe> keyframes() {
    planner::PlannedKeyframe a{"A", {}, {}, {SlotId(1), SlotId(2), SlotId(0)}, 24'000, 27'000};
    a.formation_m = {formation_a()[2], formation_a()[0], formation_a()[1]};
    a.colors = {{0.75, 0.75, 0.25}, {1.0, 0.5, 0.0}, {0.0, 1.0, 0.5}};
    planner::PlannedKeyframe b{"B", formation_b(), {}, {SlotId(0), SlotId(1), SlotId(2)}, 36'600, 40'600};
    b.colors = {{0.0, 0.25, 1.0}, {0.0, 1.0, 0.5}, {0.0, 0.0, 1.0}};
    return {a, b};
}

/// Numbers chosen to be told apart, not computed: tests of writers need no certifier.
inline planner::Certificate certificate(const std::vector<planner::Act>& acts) {
    planner::Certificate result;
    for (const planner::Act& act : acts) {
        const double i = static_cast<double>(result.acts.size());
        planner::ActCertificate c;
        c.name = act.name;
        c.role = act.role;
        c.start_ms = act.start_ms;
        c.duration_ms = act.duration_ms;
        c.required_separation_m = 1.55;
        c.separation = {2.0 + 0.125 * i, planner::Encounter{DroneId(0), DroneId(1), 0.5 * i, 2.03125 + 0.125 * i}};
        c.extremes = {1.0 + i, 0.5, 0.25, 0.75, 1.5};
        c.altitude_min_m = 0.0;
        c.altitude_max_m = 5.0 + i;
        c.geofence_margin_m = 12.5;
        c.obstacle_margin_m = 8.25;
        c.method = act.role == planner::ActRole::hold ? "hold" : "straight";
        c.assignment = "shortest, gap 0, pairwise";
        c.path_ratio = 1.0;
        result.acts.push_back(c);
    }
    return result;
}

inline planner::FlightPlan show() {
    planner::FlightPlan plan;
    plan.name = "Fixed \u00e9tude";
    plan.origin = {{35.65860, 139.74540, 40.0}, 20.0, 36.7};
    plan.airspace = airspace();
    plan.endurance_s = 600.0;
    plan.pads_m = pads();
    plan.acts = acts();
    plan.tracks = tracks();
    plan.keyframes = keyframes();
    plan.cues = {{24'000, "A stands"}, {36'600, "finale"}};
    plan.certificate = certificate(plan.acts);
    return plan;
}

}  // namespace aerogram::exporter::fixed
