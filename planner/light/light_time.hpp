#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "geo/result.hpp"
#include "planner/mission/mission.hpp"
#include "planner/motion/act.hpp"
#include "planner/motion/flight_plan.hpp"

namespace aerogram::planner {

/// Light times are multiples of this.
inline constexpr Millis kLightTick_ms = 20;

/// What lights shine on: a show whose acts are timed.
struct LightStage {
    std::span<const PlannedKeyframe> keyframes;  ///< one for each of the mission's
    std::span<const Act> acts;                   ///< >= 1
    std::span<const Group> groups;               ///< the mission's, clusters filled
};

/// From one show time to another.
struct TimeSpan {
    Millis from_ms = 0, to_ms = 0;
    bool operator==(const TimeSpan&) const = default;
};

/// When lamps may shine: from the end of the last take-off to the beginning of the first landing, rounded inwards to
/// light ticks; the whole show where there are none.
[[nodiscard]] TimeSpan lamp_time(std::span<const Act> acts);

/// Time steps between samples of lights: 1 / rate, rounded to light ticks, at least one.
[[nodiscard]] Millis light_step_ms(double rate_hz);

/// Keyframes that a light belongs to: one, all frames of an animation, or all of them where it names none.
struct KeyframeRange {
    std::size_t first = 0, last = 0;
};
/// Errors: invalid_input when no keyframe is called so.
Result<KeyframeRange> keyframes_of(const Mission& mission, const Light& light);

/// When a light does what. A fade whose fade_out_s is 0 outlasts its time: it stays until its formation leaves and goes
/// over into the colours beneath until the next one stands.
struct LightTime {
    TimeSpan own;            ///< its time: effects are functions of where in it they are; light ticks
    Millis stays_to_ms = 0;  ///< a fade stays as it ended until here; >= own.to_ms
    Millis gone_at_ms = 0;   ///< and is gone here; >= stays_to_ms
    TimeSpan lit;            ///< when anything of it is to be seen: within lamp_time

    [[nodiscard]] double since_s(Millis time_ms) const;
    /// Share of its time that is over, clamped to [0, 1].
    [[nodiscard]] double progress(Millis time_ms) const;
    /// How much of it fading in, fading out and going over leave, [0, 1].
    [[nodiscard]] double envelope(const Light& light, Millis time_ms) const;
};
/// @param index  into mission.lights. Errors: invalid_input at the light's line when nothing of it would be seen.
Result<LightTime> light_time(const Mission& mission, std::size_t index, const LightStage& stage);

/// What stands or is on its way: keyframe `from` goes over into `to`, by `share`. Before the first of a range and after
/// its last: that one.
struct Passage {
    std::size_t from = 0, to = 0;
    double share = 0.0;
};
[[nodiscard]] Passage passage_at(const LightStage& stage, const KeyframeRange& range, Millis time_ms);

}  // namespace aerogram::planner
