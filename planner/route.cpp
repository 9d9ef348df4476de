#include "planner/route.hpp"

#include <algorithm>
#include <optional>
#include <sstream>

#include "planner/assignment/assignment.hpp"
#include "planner/formation/formation.hpp"
#include "planner/formation_match.hpp"
#include "planner/gather.hpp"
#include "planner/group_match.hpp"
#include "planner/hold_motion.hpp"
#include "planner/leg_shape.hpp"
#include "planner/transition/hierarchy.hpp"

namespace aerogram::planner {
namespace {

/// A relative duality gap that is rounding only.
constexpr double kOptimalGap = 1e-12;

std::string describe(const char* how, const Assignment& assignment) {
    std::ostringstream text;
    text << how;
    if (assignment.duality_gap > kOptimalGap) text << ", gap " << assignment.duality_gap;
    if (assignment.pairwise) {
        text << ", no paths cross";
    } else if (assignment.crossing) {
        text << ", paths of drones " << assignment.crossing->first.number() << " and "
             << assignment.crossing->second.number() << " cross";
    }
    return text.str();
}

Result<Assignment> assign(const Mission& mission, const Route& route, const Keyframe& keyframe,
                          const Formation& formation, const Points& from_m, const Run& run) {
    const SeparationMetric metric{mission.limits.downwash};
    const Arrive& arrive = keyframe.arrive;
    const MatchRules rules{arrive.pins, arrive.forbid};
    switch (arrive.assign) {
        case Assign::shortest:
            return assign_shortest(from_m, formation.points_m, rules, metric, run);
        case Assign::bottleneck:
            return assign_bottleneck(from_m, formation.points_m, rules, metric, run);
        case Assign::keep:
        case Assign::slots:  // of the first keyframe: there were no slots before
            return assign_keep(from_m, formation.points_m, rules, metric);
        case Assign::formation_coordinates:
            return assign_formation_coordinates(from_m, formation.points_m, formation.spare, rules, metric, run);
        case Assign::groups:
            break;
    }
    auto match = match_groups(route.groups, keyframe, formation, from_m.size());
    if (!match) return match.error();
    return assign_groups(from_m, formation.points_m, *match, rules, metric, run);
}

const char* name_of(Assign assign) {
    switch (assign) {
        case Assign::shortest:
            return "shortest";
        case Assign::bottleneck:
            return "bottleneck";
        case Assign::keep:
            return "keep";
        case Assign::slots:
            return "slots";
        case Assign::formation_coordinates:
            return "formation coordinates";
        case Assign::groups:
            break;
    }
    return "groups";
}

/// Slots that take no part in a keyframe's own motion.
std::vector<bool> waiting_above_pads(const Mission& mission, const Formation& formation) {
    return mission.fleet.spares == Spares::pads ? formation.spare : std::vector<bool>{};
}

/// Whether a keyframe's matching depends on places alone, not on which drone is where.
bool by_places_alone(const Arrive& arrive) {
    return (arrive.assign == Assign::shortest && arrive.pins.empty() && arrive.forbid.empty()) ||
           arrive.assign == Assign::slots;
}

/// The keyframes' matchings that need no drone's name, slots of the keyframe before to slots; absent for the others.
Result<std::vector<std::optional<Assignment>>> match_places(const Mission& mission,
                                                            const std::vector<Formation>& formations, const Run& run) {
    const Run quiet{run.stop, nullptr, 1};
    return gather<std::optional<Assignment>>(
        formations.size(), run, "assign", [&](std::size_t k) -> Result<std::optional<Assignment>> {
            if (k == 0 || !by_places_alone(mission.keyframes[k].arrive)) return std::optional<Assignment>{};
            const Points from_m = after_hold(formations[k - 1].points_m, mission.keyframes[k - 1].motion,
                                             waiting_above_pads(mission, formations[k - 1]));
            const SeparationMetric metric{mission.limits.downwash};
            auto matched = mission.keyframes[k].arrive.assign == Assign::slots
                               ? assign_keep(from_m, formations[k].points_m, {}, metric)
                               : assign_shortest(from_m, formations[k].points_m, {}, metric, quiet);
            if (!matched) return matched.error();
            return std::optional(std::move(*matched));
        });
}

/// Fills the groups that the mission wants found, from the first keyframe's neighbourhoods.
Status find_clusters(const Mission& mission, Route& route, const Run& run) {
    for (std::size_t g = 0; g < route.groups.size(); ++g) {
        if (!route.groups[g].cluster) continue;
        Points among_m;
        for (const DroneId d : route.groups[g].drones) among_m.push_back(route.stops[0].by_drone_m[d.value]);
        auto found = spectral_clusters({among_m, delaunay_adjacency(among_m)}, route.groups[g].cluster->count,
                                       mission.seed, run);
        if (!found) return found.error();
        for (std::size_t c = 0; c < found->size(); ++c) {
            auto& members = route.groups[route.groups[g].inside[c]].drones;
            for (const DroneId local : (*found)[c]) members.push_back(route.groups[g].drones[local.value]);
        }
    }
    return Done{};
}

Stop stop_at(const Mission& mission, const Keyframe& keyframe, Formation formation, Assignment assignment) {
    Stop stop;
    stop.keyframe.name = keyframe.name;
    const std::vector<bool> still = waiting_above_pads(mission, formation);
    for (const SlotId slot : assignment.slot_of) {
        stop.by_drone_m.push_back(formation.points_m[slot.value]);
        stop.still.push_back(!still.empty() && still[slot.value]);
    }
    stop.left_from_m = after_hold(stop.by_drone_m, keyframe.motion, stop.still);
    stop.assignment = describe(name_of(keyframe.arrive.assign), assignment);
    if (!formation.note.empty()) stop.assignment += "; " + formation.note;
    stop.pairwise = assignment.pairwise;
    stop.keyframe.spare = std::move(formation.spare);
    stop.keyframe.formation_m = std::move(formation.points_m);
    stop.keyframe.colors = std::move(formation.colors);
    stop.keyframe.slot_of = std::move(assignment.slot_of);
    return stop;
}

}  // namespace

Result<Route> build_route(const Mission& mission, const Run& run) {
    const Run quiet{run.stop, nullptr, 1};
    auto formations = gather<Formation>(mission.keyframes.size(), run, "formations",
                                        [&](std::size_t k) { return build_formation(mission, k, quiet); });
    if (!formations) return formations.error();
    Route route{pad_layers(mission.fleet.pads_m, mission.limits), {}, mission.groups};
    auto places = match_places(mission, *formations, run);
    if (!places) return places.error();
    for (std::size_t k = 0; k < mission.keyframes.size(); ++k) {
        const Keyframe& keyframe = mission.keyframes[k];
        Assignment assignment;
        if ((*places)[k]) {
            assignment = std::move(*(*places)[k]);
            std::vector<SlotId> slot_of;
            for (const SlotId before : route.stops.back().keyframe.slot_of)
                slot_of.push_back(assignment.slot_of[before.value]);
            assignment.slot_of = std::move(slot_of);
        } else {
            const Points& here_m = k == 0 ? route.layers.lifted_m : route.stops.back().left_from_m;
            auto matched = assign(mission, route, keyframe, (*formations)[k], here_m, run);
            if (!matched) {
                const Error& error = matched.error();
                if (error.code == ErrorCode::stopped) return error;
                return Error{ErrorCode::invalid_input,
                             mission.at(keyframe.arrive.line, keyframe_key(mission, k) + ".arrive: " + error.message)};
            }
            assignment = std::move(*matched);
        }
        route.stops.push_back(stop_at(mission, keyframe, std::move((*formations)[k]), std::move(assignment)));
        if (k > 0) continue;
        if (auto done = find_clusters(mission, route, run); !done) return done.error();
    }
    return route;
}

}  // namespace aerogram::planner
