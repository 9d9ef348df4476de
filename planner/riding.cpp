#include "planner/riding.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "geo/units.hpp"
#include "planner/carrier/ride.hpp"
#include "planner/gather.hpp"
#include "planner/leg.hpp"
#include "planner/route.hpp"

namespace aerogram::planner {
namespace {

constexpr int kMostRounds = 100;  ///< of lengthening

Status check_beginning(const Mission& mission) {
    if (mission.fleet.vehicle != Vehicle::plane) return Done{};
    const Keyframe& first = mission.keyframes.front();
    const auto refused = [&](const std::string& what) {
        return Error{ErrorCode::invalid_input, mission.at(first.line, keyframe_key(mission, 0) + what)};
    };
    if (first.hold_s <= 0.0) return refused(".hold_s = 0: planes begin the show in the first keyframe; hold it");
    if (first.at_s && *first.at_s > 0.0)
        return refused(".at_s: planes begin the show in the first keyframe, which stands from 0 s on");
    return Done{};
}

/// The legs until the last formation stands. Planes do not fly the first: they begin at its end.
std::vector<Leg> legs_until_the_last_formation(const std::vector<Leg>& all, bool planes) {
    std::vector<Leg> legs;
    bool arrived = false;
    for (const Leg& leg : all) {
        if (arrived && !leg.arrives) break;
        arrived = arrived || leg.arrives;
        if (!planes || leg.arrives) legs.push_back(leg);
    }
    if (planes) legs.front().from_m = legs.front().to_m;
    return legs;
}

/// Times in whole ticks.
void round_times(Millis tick_ms, LegMotion& motion) {
    motion.shortest.duration_ms = whole_ticks(motion.shortest.duration_ms, tick_ms);
    if (!motion.wanted_s) return;
    const auto wanted_ms = static_cast<Millis>(std::ceil(*motion.wanted_s * 1000.0 - 1e-6));
    motion.wanted_s = seconds_from_ms(whole_ticks(wanted_ms, tick_ms));
}

/// Planes do not fly their first leg: they stand, as it were, at its end.
void leave_out(LegMotion& motion) {
    motion.motion = Hold{end_positions(motion.motion)};
    motion.shortest = {};
    motion.wanted_s.reset();
}

std::size_t first_ridden(const std::vector<Act>& acts) {
    const auto held = std::ranges::find(acts, ActRole::hold, &Act::role);
    return static_cast<std::size_t>(held - acts.begin());
}

/// A leg that takes longer. What starts by and by is planned anew for that time, unless the designer gave another.
Status lengthen(const Mission& placed, const Route& route, Leg& leg, LegMotion& motion, const TooFast& wish,
                const Run& run) {
    if (!motion.fixed || placed.keyframes[leg.last].arrive.duration_s) {
        motion.shortest = {wish.duration_ms, wish.limit};
        return Done{};
    }
    leg.how.duration_s = seconds_from_ms(wish.duration_ms);
    auto longer = plan_leg(placed, route, leg, run);
    if (!longer) return longer.error();
    motion = std::move(*longer);
    round_times(ride_tick_ms(placed.fleet.drones), motion);
    return Done{};
}

/// Builds the timeline, longer and longer, until the ride holds; puts the ridden acts into it.
Result<Ride> ride_timeline(const Mission& mission, const Mission& placed, const Route& route, std::vector<Leg>& legs,
                           std::vector<LegMotion>& motions, const Run& run, Timeline& timeline) {
    TooFast last;
    for (int round = 0; round < kMostRounds; ++round) {
        run.report("ride", static_cast<double>(round) / kMostRounds);
        auto built = build_timeline(placed, route, legs, motions);
        if (!built) return built.error();
        const std::size_t begin = first_ridden(built->acts);
        auto out = ride(mission, std::span(built->acts).subspan(begin), run);
        if (!out) return out.error();
        if (out->too_fast.empty()) {
            std::ranges::move(out->acts, built->acts.begin() + static_cast<std::ptrdiff_t>(begin));
            timeline = std::move(*built);
            run.report("ride", 1.0);
            return out;
        }
        for (const TooFast& wish : out->too_fast) {
            last = wish;
            const std::size_t leg = *built->leg_of[begin + wish.act];
            if (auto done = lengthen(placed, route, legs[leg], motions[leg], wish, run); !done) return done.error();
        }
    }
    return Error{ErrorCode::infeasible,
                 mission.at(mission.carrier->line, "carrier: the flights do not hold " + last.limit +
                                                       " on this route, however long they are made")};
}

/// Keyframes as they stand when their time begins.
/// @param turned_rad  at the start of the route.
void carry_keyframes(const Ride& ride, Millis begin_ms, double turned_rad, std::vector<PlannedKeyframe>& keyframes) {
    for (PlannedKeyframe& keyframe : keyframes) {
        keyframe.turned_rad = turned_rad;
        if (keyframe.stands_from_ms < begin_ms) continue;
        const double ridden_s = seconds_from_ms(keyframe.stands_from_ms - begin_ms);
        keyframe.turned_rad += ride.carrier.turned_rad(ridden_s);
        for (Vec3& p : keyframe.formation_m) p = ride.carrier.carried(p, ridden_s);
    }
}

Status return_home(const Mission& mission, const Route& route, const std::vector<Leg>& all, Flown& flown,
                   const Run& run) {
    Points here_m = end_positions(flown.timeline.acts.back().motion);
    for (auto leg = std::ranges::find_if(all, [](const Leg& l) { return l.name == "return" && !l.arrives; });
         leg != all.end(); ++leg) {
        Leg moved = *leg;
        if (moved.role == ActRole::transit) moved.from_m = here_m;
        auto motion = plan_leg(mission, route, moved, run);
        if (!motion) return motion.error();
        Act act{moved.name,
                moved.role,
                Timing::free,
                flown.timeline.acts.back().end_ms(),
                motion->shortest.duration_ms,
                std::move(motion->motion)};
        flown.legs.push_back(std::move(moved));
        flown.reports.push_back(std::move(motion->report));
        if (act.duration_ms == 0) continue;
        flown.timeline.acts.push_back(std::move(act));
        flown.timeline.leg_of.push_back(flown.legs.size() - 1);
    }
    return Done{};
}

}  // namespace

Result<Flown> plan_riding(const Mission& mission, const Run& run) {
    if (auto sound = check_beginning(mission); !sound) return sound.error();
    const bool planes = mission.fleet.vehicle == Vehicle::plane;
    const auto placed = placed_at_start(mission);
    if (!placed) return placed.error();
    const auto route = build_route(*placed, run);
    if (!route) return route.error();
    const std::vector<Leg> all = legs_of(*placed, *route);
    Flown flown{legs_until_the_last_formation(all, planes), {}, {}, route->groups};
    for (Leg& leg : flown.legs) leg.may_swap = false;  // the ride lengthens legs one by one, as they are
    const Run quiet{run.stop, nullptr, 1};
    auto motions = gather<LegMotion>(flown.legs.size(), run, "transitions",
                                     [&](std::size_t l) { return plan_leg(*placed, *route, flown.legs[l], quiet); });
    if (!motions) return motions.error();
    for (LegMotion& motion : *motions) round_times(ride_tick_ms(mission.fleet.drones), motion);
    if (planes) leave_out(motions->front());
    const auto ridden = ride_timeline(mission, *placed, *route, flown.legs, *motions, run, flown.timeline);
    if (!ridden) return ridden.error();
    for (std::size_t l = 0; l < motions->size(); ++l) {
        flown.reports.push_back((*motions)[l].report);
        flown.reports.back().required_separation_m = required_separation_m(mission, flown.legs[l]);
    }
    const double turned_rad = mission.carrier->turn ? CarrierPath::through(mission).value().yaw_rad(0.0) : 0.0;
    carry_keyframes(*ridden, ridden->acts.front().start_ms, turned_rad, flown.timeline.keyframes);
    if (planes) return flown;
    if (auto home = return_home(mission, *route, all, flown, run); !home) return home.error();
    return flown;
}

}  // namespace aerogram::planner
