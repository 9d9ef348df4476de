#include "planner/leg.hpp"

#include <algorithm>

namespace aerogram::planner {
namespace {

std::string wave_name(const char* name, std::uint32_t wave, std::uint32_t waves) {
    return waves == 1 ? name : std::string(name) + " " + std::to_string(wave + 1) + " of " + std::to_string(waves);
}

/// Take-off, or landing when `down`: one leg a layer, the highest first on the way up and last on the way down.
void add_waves(std::vector<Leg>& legs, const Mission& mission, const PadLayers& layers, bool down) {
    Points here_m = down ? layers.lifted_m : mission.fleet.pads_m;
    const Points& there_m = down ? mission.fleet.pads_m : layers.lifted_m;
    for (std::uint32_t wave = 0; wave < layers.count; ++wave) {
        Leg leg;
        leg.name = wave_name(down ? "landing" : "take-off", wave, layers.count);
        leg.role = down ? ActRole::landing : ActRole::takeoff;
        leg.assignment = "own pad";
        leg.from_m = here_m;
        const std::uint32_t layer = down ? wave : layers.count - 1 - wave;
        for (std::size_t d = 0; d < here_m.size(); ++d)
            if (layers.layer_of[d] == layer) here_m[d] = there_m[d];
        leg.to_m = here_m;
        legs.push_back(std::move(leg));
    }
}

/// Whether the drones that arrive at keyframe k, and at all after it, are exchangeable.
bool nobody_is_named_from(const Mission& mission, std::size_t k) {
    const auto by_places_alone = [](const Keyframe& keyframe) {
        const Arrive& how = keyframe.arrive;
        return how.assign == Assign::shortest && how.pins.empty() && how.forbid.empty();
    };
    return mission.groups.empty() && mission.adjacency.empty() && !mission.carrier &&
           std::all_of(mission.keyframes.begin() + static_cast<std::ptrdiff_t>(k), mission.keyframes.end(),
                       by_places_alone);
}

/// The arrival at keyframe k, or the flow that begins there.
Leg arrival(const Mission& mission, const Route& route, std::size_t k) {
    Leg leg;
    leg.arrives = true;
    leg.first = leg.last = k;
    const auto flows = [&](std::size_t q) { return mission.keyframes[q].arrive.method == Method::flow; };
    while (flows(k) && leg.last + 1 < route.stops.size() && flows(leg.last + 1) &&
           mission.keyframes[leg.last].hold_s == 0.0) {
        ++leg.last;
    }
    const Stop& stop = route.stops[leg.last];
    leg.name = (leg.first == leg.last ? "to " : "flow to ") + stop.keyframe.name;
    leg.how = mission.keyframes[leg.last].arrive;
    leg.from_m = k == 0 ? route.layers.lifted_m : route.stops[k - 1].left_from_m;
    leg.to_m = stop.by_drone_m;
    leg.assignment = stop.assignment;
    leg.may_swap = leg.how.method != Method::flow && nobody_is_named_from(mission, k);
    for (std::size_t q = leg.first; q <= leg.last; ++q) {  // a flow keeps the most that any of its legs asks for
        const auto& asked_m = mission.keyframes[q].arrive.min_separation_m;
        if (asked_m) leg.how.min_separation_m = std::max(*asked_m, leg.how.min_separation_m.value_or(0.0));
    }
    for (std::size_t q = leg.first; q <= leg.last; ++q) leg.pairwise = leg.pairwise && route.stops[q].pairwise;
    return leg;
}

}  // namespace

std::vector<Leg> legs_of(const Mission& mission, const Route& route) {
    std::vector<Leg> legs;
    add_waves(legs, mission, route.layers, false);
    for (std::size_t k = 0; k < route.stops.size(); k = legs.back().last + 1)
        legs.push_back(arrival(mission, route, k));
    Leg back;
    back.name = "return";
    back.from_m = route.stops.back().left_from_m;
    back.to_m = route.layers.lifted_m;
    back.assignment = "own pad";
    back.pairwise = false;
    back.how.profile = ProfileKind::s_curve;  // long and mostly downwards: a quarter faster than minimum jerk
    legs.push_back(std::move(back));
    add_waves(legs, mission, route.layers, true);
    return legs;
}

double required_separation_m(const Mission& mission, const Leg& leg) {
    const double planned_m = planned_separation_m(mission.limits);
    return std::max(planned_m, leg.how.min_separation_m.value_or(0.0) + mission.limits.export_margin_m);
}

}  // namespace aerogram::planner
