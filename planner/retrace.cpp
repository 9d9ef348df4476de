#include "planner/retrace.hpp"

#include <algorithm>

#include "planner/hold_motion.hpp"

namespace aerogram::planner {
namespace {

Motion backwards(const Motion& motion) {
    if (const auto* straight = std::get_if<Straight>(&motion)) {
        Straight back{straight->to_m, straight->from_m, straight->profile};
        std::ranges::reverse(back.profile);
        for (double& share : back.profile) share = 1.0 - share;
        return back;
    }
    if (const auto* lattice = std::get_if<Lattice>(&motion)) {
        Lattice back{lattice->drones, {}};
        back.points_m.reserve(lattice->points_m.size());
        for (std::size_t row = lattice->rows(); row-- > 0;)
            for (std::size_t i = 0; i < lattice->drones; ++i) back.points_m.push_back(lattice->at(row, i));
        return back;
    }
    return motion;
}

void add(Ways& ways, const Mission& mission, const Motion& forth, const LegReport& how) {
    Leg leg;
    leg.assignment = "own pad";
    leg.pairwise = false;
    LegMotion back;
    back.motion = backwards(forth);
    back.shortest = shortest_duration(back.motion, mission.limits);
    back.report.method = how.method;
    back.report.path_ratio = how.path_ratio;
    back.report.required_separation_m = planned_separation_m(mission.limits);
    back.report.separation_by = "the way out flown backwards, because straight ways home come too close";
    leg.from_m = start_positions(back.motion);
    leg.to_m = end_positions(back.motion);
    ways.legs.push_back(std::move(leg));
    ways.motions.push_back(std::move(back));
}

}  // namespace

Ways retrace(const Mission& mission, const Route& route, std::span<const Leg> legs,
             std::span<const LegMotion> motions) {
    Ways ways;
    for (std::size_t l = legs.size(); l-- > 0;) {
        if (!legs[l].arrives) continue;
        const std::size_t k = legs[l].last;
        const HoldMotion& hold = mission.keyframes[k].motion;
        if (hold.displaces()) {
            LegReport standing;
            standing.method = "hold";
            add(ways, mission, hold_lattice(route.stops[k].by_drone_m, hold, route.stops[k].still), standing);
        }
        add(ways, mission, motions[l].motion, motions[l].report);
    }
    for (std::size_t w = 0; w < ways.legs.size(); ++w)
        ways.legs[w].name = "return " + std::to_string(w + 1) + " of " + std::to_string(ways.legs.size());
    return ways;
}

}  // namespace aerogram::planner
