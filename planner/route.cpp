#include "planner/route.hpp"

#include <algorithm>
#include <optional>
#include <sstream>

#include "planner/assignment/assignment.hpp"
#include "planner/formation/formation.hpp"

namespace aerogram::planner {
namespace {

/// Take-off climbs this far above the minimum navigation altitude, so that neither the earth's curvature nor a file's
/// rounding puts a sideways motion below it.
constexpr double kClearOfFloor_m = 0.1;
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

/// The mission's groups, and the drones outside all of them as one more, against the keyframe's parts: those of one
/// group together, each other part by itself.
GroupMatch match_groups(const Mission& mission, const Keyframe& keyframe, const Formation& formation) {
    GroupMatch match;
    std::vector<bool> grouped(mission.fleet.drones, false);
    for (const Group& group : mission.groups) {
        match.drones.push_back(group.drones);
        for (const DroneId drone : group.drones) grouped[drone.value] = true;
    }
    std::vector<DroneId> rest;
    for (std::size_t d = 0; d < grouped.size(); ++d) {
        if (!grouped[d]) rest.emplace_back(d);
    }
    if (!rest.empty()) match.drones.push_back(rest);
    match.wanted.resize(match.drones.size());

    std::vector<std::size_t> set_of_part(keyframe.parts.size());
    for (std::size_t p = 0; p < keyframe.parts.size(); ++p) {
        const auto group = std::ranges::find(mission.groups, keyframe.parts[p].group, &Group::name);
        std::optional<std::size_t>* wanted =
            group == mission.groups.end() ? nullptr
                                          : &match.wanted[static_cast<std::size_t>(group - mission.groups.begin())];
        set_of_part[p] = wanted != nullptr && *wanted ? **wanted : match.slots.size();
        if (set_of_part[p] == match.slots.size()) match.slots.emplace_back();
        if (wanted != nullptr) *wanted = set_of_part[p];
    }
    for (std::size_t s = 0; s < formation.part.size(); ++s) match.slots[set_of_part[formation.part[s]]].emplace_back(s);
    return match;
}

Result<Assignment> assign(const Mission& mission, const Keyframe& keyframe, const Formation& formation,
                          const Points& from_m, const Run& run) {
    const SeparationMetric metric{mission.limits.downwash};
    const Arrive& arrive = keyframe.arrive;
    switch (arrive.assign) {
        case Assign::shortest:
            return assign_shortest(from_m, formation.points_m, arrive.pins, metric, run);
        case Assign::bottleneck:
        case Assign::keep:
            return assign_keep(from_m, formation.points_m, arrive.pins, metric);
        case Assign::groups:
            break;
    }
    return assign_groups(from_m, formation.points_m, match_groups(mission, keyframe, formation), arrive.pins, metric,
                         run);
}

const char* name_of(Assign assign) {
    switch (assign) {
        case Assign::shortest:
            return "shortest";
        case Assign::bottleneck:
            return "bottleneck";
        case Assign::keep:
            return "keep";
        case Assign::groups:
            break;
    }
    return "groups";
}

}  // namespace

Result<Route> build_route(const Mission& mission, const Run& run) {
    Route route;
    route.lifted_m = mission.fleet.pads_m;
    for (Vec3& p : route.lifted_m) p.z += mission.limits.min_navigation_altitude_m + kClearOfFloor_m;
    const Points* here_m = &route.lifted_m;
    route.stops.reserve(mission.keyframes.size());  // keeps here_m valid
    for (std::size_t k = 0; k < mission.keyframes.size(); ++k) {
        if (run.stopped()) return stopped_error();
        run.report("formations", static_cast<double>(k) / static_cast<double>(mission.keyframes.size()));
        const Keyframe& keyframe = mission.keyframes[k];
        auto formation = build_formation(mission, k, run);
        if (!formation) return formation.error();
        auto assignment = assign(mission, keyframe, *formation, *here_m, run);
        if (!assignment) {
            const Error& error = assignment.error();
            if (error.code == ErrorCode::stopped) return error;
            return Error{ErrorCode::invalid_input,
                         mission.at(keyframe.arrive.line, keyframe_key(k) + ".arrive: " + error.message)};
        }
        Stop stop;
        stop.keyframe.name = keyframe.name;
        stop.by_drone_m.resize(mission.fleet.drones);
        for (std::size_t d = 0; d < mission.fleet.drones; ++d) {
            stop.by_drone_m[d] = formation->points_m[assignment->slot_of[d].value];
        }
        stop.assignment = describe(name_of(keyframe.arrive.assign), *assignment);
        stop.pairwise = assignment->pairwise;
        stop.keyframe.formation_m = std::move(formation->points_m);
        stop.keyframe.colors = std::move(formation->colors);
        stop.keyframe.slot_of = std::move(assignment->slot_of);
        route.stops.push_back(std::move(stop));
        here_m = &route.stops.back().by_drone_m;
    }
    run.report("formations", 1.0);
    return route;
}

}  // namespace aerogram::planner
