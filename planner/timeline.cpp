#include "planner/timeline.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "geo/contract.hpp"
#include "geo/units.hpp"
#include "planner/hold_motion.hpp"
#include "planner/motion/timing.hpp"
#include "planner/sampling/closest_pair.hpp"

namespace aerogram::planner {
namespace {

constexpr Millis kLightTick_ms = 20;

Millis milliseconds(double seconds) {
    return static_cast<Millis>(std::llround(seconds * 1000.0));
}

std::string number(double value) {
    std::ostringstream text;
    text << std::setprecision(10) << value;
    return text.str();
}

std::string rounded_up_s(Millis ms) {
    std::ostringstream text;
    text << std::fixed << std::setprecision(3) << seconds_from_ms(ms);
    return text.str();
}

class Builder {
  public:
    Builder(const Mission& mission, const Route& route) : mission_(mission), route_(route) {
        for (const Stop& stop : route.stops) timeline_.keyframes.push_back(stop.keyframe);
    }

    Status add(std::size_t index, const Leg& leg, LegMotion motion) {
        Millis duration_ms = motion.shortest.duration_ms;
        if (leg.arrives) {
            auto timed = timed_arrival(leg, motion);
            if (!timed) return timed.error();
            duration_ms = *timed;
        }
        const bool given = leg.arrives && (motion.wanted_s || mission_.keyframes[leg.last].at_s);
        const Timing timing = given ? Timing::fixed : Timing::free;
        if (duration_ms > 0) append({leg.name, leg.role, timing, 0, duration_ms, std::move(motion.motion)}, index);
        return leg.arrives ? stand(leg, motion, duration_ms) : Status(Done{});
    }

    Timeline result() && { return std::move(timeline_); }

  private:
    Millis now_ms() const { return timeline_.acts.empty() ? 0 : timeline_.acts.back().end_ms(); }

    void append(Act act, std::optional<std::size_t> leg) {
        act.start_ms = now_ms();
        timeline_.acts.push_back(std::move(act));
        timeline_.leg_of.push_back(leg);
    }

    /// How long an arrival takes; lengthens the hold before it where the mission asks for that.
    Result<Millis> timed_arrival(const Leg& leg, const LegMotion& motion) {
        const Millis shortest_ms = motion.shortest.duration_ms;
        const Keyframe& keyframe = mission_.keyframes[leg.last];
        const std::string key = keyframe_key(mission_, leg.last);
        Millis duration_ms = shortest_ms;
        if (motion.wanted_s) {
            duration_ms = milliseconds(*motion.wanted_s);
            if (duration_ms < shortest_ms && !keyframe.clip.empty()) {
                return Error{ErrorCode::invalid_input,
                             mission_.at(keyframe.line, key + ".animation.duration_s: the frames take " +
                                                            number(*motion.wanted_s) +
                                                            " s in all: must be >= " + rounded_up_s(shortest_ms) +
                                                            " (set by " + motion.shortest.set_by + ")")};
            }
            if (duration_ms < shortest_ms) {
                return Error{ErrorCode::invalid_input,
                             mission_.at(keyframe.arrive.line,
                                         key + ".arrive.duration_s = " + number(*motion.wanted_s) + ": must be >= " +
                                             rounded_up_s(shortest_ms) + " (set by " + motion.shortest.set_by + ")")};
            }
        }
        if (!keyframe.at_s) return duration_ms;
        const Millis spare_ms = milliseconds(*keyframe.at_s) - (now_ms() + duration_ms);
        if (spare_ms < 0) {
            return Error{
                ErrorCode::invalid_input,
                mission_.at(keyframe.line, key + ".at_s = " + number(*keyframe.at_s) + ": the earliest possible is " +
                                               rounded_up_s(now_ms() + duration_ms))};
        }
        if (!motion.wanted_s && duration_ms > 0) return duration_ms + spare_ms;
        if (spare_ms > 0) {
            Act& before = timeline_.acts.back();
            if (before.role != ActRole::hold) {
                return Error{
                    ErrorCode::invalid_input,
                    mission_.at(keyframe.line,
                                key + ".at_s = " + number(*keyframe.at_s) +
                                    ": with this duration_s nothing can wait; leave out duration_s, or at_s = " +
                                    rounded_up_s(now_ms() + duration_ms))};
            }
            before.duration_ms += spare_ms;
            timeline_.keyframes[leg.first - 1].stands_to_ms += spare_ms;
        }
        return duration_ms;
    }

    /// Standing times of the keyframes a leg reached, and the hold at its end.
    Status stand(const Leg& leg, const LegMotion& motion, Millis duration_ms) {
        const Millis arrival_ms = now_ms(), start_ms = arrival_ms - duration_ms;
        for (std::size_t k = leg.first; k < leg.last; ++k) {
            const double share = static_cast<double>(motion.keyframe_knots[k - leg.first]) /
                                 static_cast<double>(motion.keyframe_knots.back());
            timeline_.keyframes[k].stands_from_ms = timeline_.keyframes[k].stands_to_ms =
                start_ms + static_cast<Millis>(std::llround(share * static_cast<double>(duration_ms)));
        }
        PlannedKeyframe& standing = timeline_.keyframes[leg.last];
        const Millis hold_ms = milliseconds(mission_.keyframes[leg.last].hold_s);
        standing.stands_from_ms = arrival_ms;
        standing.stands_to_ms = arrival_ms + hold_ms;
        if (hold_ms == 0) return Done{};
        const HoldMotion& moves = mission_.keyframes[leg.last].motion;
        if (auto roomy = keeps_room(leg, moves); !roomy) return roomy.error();
        Motion hold = moves.moves() ? Motion(hold_lattice(leg.to_m, moves, route_.stops[leg.last].still))
                                    : Motion(Hold{leg.to_m});
        const ShortestDuration shortest = shortest_duration(hold, mission_.limits);
        if (hold_ms < shortest.duration_ms) {
            return Error{ErrorCode::invalid_input,
                         mission_.at(mission_.keyframes[leg.last].line,
                                     keyframe_key(mission_, leg.last) +
                                         ".hold_s = " + number(seconds_from_ms(hold_ms)) + ": its motion needs >= " +
                                         rounded_up_s(shortest.duration_ms) + " (set by " + shortest.set_by + ")")};
        }
        append({standing.name, ActRole::hold, Timing::fixed, 0, hold_ms, std::move(hold)}, std::nullopt);
        return Done{};
    }

    /// A formation that shrinks must still keep the separation.
    [[nodiscard]] Status keeps_room(const Leg& leg, const HoldMotion& moves) const {
        Points moving_m;
        const std::vector<bool>& still = route_.stops[leg.last].still;
        for (std::size_t d = 0; d < leg.to_m.size(); ++d)
            if (still.empty() || !still[d]) moving_m.push_back(leg.to_m[d]);
        if (moves.scale >= 1.0 || moving_m.size() < 2) return Done{};
        const double spacing_m = closest_pair(moving_m, {mission_.limits.downwash}).distance_m;
        const double needed_m = planned_separation_m(mission_.limits);
        if (spacing_m * moves.scale >= needed_m) return Done{};
        std::ostringstream least;
        least << std::setprecision(3) << std::ceil(needed_m / spacing_m * 1000.0) / 1000.0;
        return Error{ErrorCode::invalid_input,
                     mission_.at(mission_.keyframes[leg.last].line,
                                 keyframe_key(mission_, leg.last) + ".motion.scale = " + number(moves.scale) +
                                     ": brings drones closer than " + number(needed_m) +
                                     " m; must be >= " + least.str() + ", or the formation larger")};
    }

    const Mission& mission_;
    const Route& route_;
    Timeline timeline_;
};

Millis to_tick(Millis ms) {
    return (ms + kLightTick_ms / 2) / kLightTick_ms * kLightTick_ms;
}

/// Appends a key; of two at the same instant the later one counts.
void add_key(std::vector<LightKey>& keys, LightKey key) {
    if (!keys.empty() && keys.back().time_ms == key.time_ms) keys.pop_back();
    keys.push_back(key);
}

}  // namespace

Result<Timeline> build_timeline(const Mission& mission, const Route& route, const std::vector<Leg>& legs,
                                std::vector<LegMotion> motions) {
    AEROGRAM_REQUIRE(legs.size() == motions.size(), legs.size(), motions.size());
    Builder builder(mission, route);
    for (std::size_t l = 0; l < legs.size(); ++l) {
        if (auto done = builder.add(l, legs[l], std::move(motions[l])); !done) return done.error();
    }
    return std::move(builder).result();
}

std::vector<Tracks> build_tracks(const std::vector<PlannedKeyframe>& keyframes, const std::vector<Act>& acts,
                                 std::size_t drones) {
    Millis lifted_ms = 0, over_pad_ms = acts.back().end_ms();
    for (const Act& act : acts) {
        if (act.role == ActRole::takeoff) lifted_ms = act.end_ms();
    }
    const auto landing = std::ranges::find(acts, ActRole::landing, &Act::role);  // the first of its waves
    if (landing != acts.end()) over_pad_ms = landing->start_ms;
    std::vector<Tracks> tracks(drones);
    for (std::size_t d = 0; d < drones; ++d) {
        auto& keys = tracks[d].lights;
        add_key(keys, {0, Rgb{}, false});
        add_key(keys, {to_tick(lifted_ms), Rgb{}, true});
        for (const PlannedKeyframe& keyframe : keyframes) {
            const Rgb color = keyframe.colors[keyframe.slot_of[d].value];
            add_key(keys, {to_tick(keyframe.stands_from_ms), color, false});
            add_key(keys, {to_tick(keyframe.stands_to_ms), color, true});
        }
        add_key(keys, {to_tick(over_pad_ms), Rgb{}, false});
    }
    return tracks;
}

}  // namespace aerogram::planner
