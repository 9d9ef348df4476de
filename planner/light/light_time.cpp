#include "planner/light/light_time.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "geo/contract.hpp"
#include "geo/units.hpp"

namespace aerogram::planner {
namespace {

Millis to_tick(Millis ms) {
    return static_cast<Millis>(std::llround(static_cast<double>(ms) / kLightTick_ms)) * kLightTick_ms;
}

Millis to_tick(double seconds) {
    return static_cast<Millis>(std::llround(seconds * 1000.0 / kLightTick_ms)) * kLightTick_ms;
}

std::string seconds(Millis ms) {
    std::ostringstream text;
    text << seconds_from_ms(ms);
    return text.str();
}

/// The first keyframe of a show that stands later than a time; their number when none does.
std::size_t next_keyframe(const LightStage& stage, Millis time_ms) {
    const auto later = std::ranges::find_if(
        stage.keyframes, [&](const PlannedKeyframe& keyframe) { return to_tick(keyframe.stands_from_ms) > time_ms; });
    return static_cast<std::size_t>(later - stage.keyframes.begin());
}

/// How a fade that ends at end_ms goes over into what comes next. Frames of an animation count as one formation.
void outlast(const Mission& mission, const LightStage& stage, Millis end_ms, const TimeSpan& lamps, LightTime& time) {
    std::size_t next = next_keyframe(stage, end_ms);
    const auto& keyframes = mission.keyframes;
    while (next > 0 && next < keyframes.size() && !keyframes[next].clip.empty() &&
           keyframes[next].clip == keyframes[next - 1].clip) {
        ++next;
    }
    time.stays_to_ms = end_ms;
    if (next > 0) time.stays_to_ms = std::max(end_ms, to_tick(stage.keyframes[next - 1].stands_to_ms));
    const Millis there_ms = next < stage.keyframes.size() ? to_tick(stage.keyframes[next].stands_from_ms) : lamps.to_ms;
    time.gone_at_ms = std::max(time.stays_to_ms, there_ms);
}

}  // namespace

TimeSpan lamp_time(std::span<const Act> acts) {
    AEROGRAM_REQUIRE(!acts.empty());
    Millis lifted_ms = 0, over_pad_ms = acts.back().end_ms();
    for (const Act& act : acts) {
        if (act.role == ActRole::takeoff) lifted_ms = act.end_ms();
    }
    const auto landing = std::ranges::find(acts, ActRole::landing, &Act::role);
    if (landing != acts.end()) over_pad_ms = landing->start_ms;
    const Millis from_ms = (lifted_ms + kLightTick_ms - 1) / kLightTick_ms * kLightTick_ms;
    return {from_ms, std::max(from_ms, over_pad_ms / kLightTick_ms * kLightTick_ms)};
}

Millis light_step_ms(double rate_hz) {
    AEROGRAM_REQUIRE(rate_hz > 0.0, rate_hz);
    return std::max<Millis>(kLightTick_ms, to_tick(1.0 / rate_hz));
}

Result<KeyframeRange> keyframes_of(const Mission& mission, const Light& light) {
    AEROGRAM_REQUIRE(!mission.keyframes.empty());
    if (light.keyframe.empty()) return KeyframeRange{0, mission.keyframes.size() - 1};
    KeyframeRange range{mission.keyframes.size(), 0};
    for (std::size_t k = 0; k < mission.keyframes.size(); ++k) {
        if (mission.keyframes[k].name != light.keyframe && mission.keyframes[k].clip != light.keyframe) continue;
        range.first = std::min(range.first, k);
        range.last = k;
    }
    if (range.first <= range.last) return range;
    return Error{ErrorCode::invalid_input,
                 mission.at(light.line, "light.keyframe = \"" + light.keyframe + "\": no keyframe is called so")};
}

double LightTime::since_s(Millis time_ms) const {
    return seconds_from_ms(time_ms - own.from_ms);
}

double LightTime::progress(Millis time_ms) const {
    const double length_s = since_s(own.to_ms);
    return length_s > 0.0 ? std::clamp(since_s(time_ms) / length_s, 0.0, 1.0) : 1.0;
}

double LightTime::envelope(const Light& light, Millis time_ms) const {
    if (time_ms > stays_to_ms)
        return std::max(0.0, seconds_from_ms(gone_at_ms - time_ms) / seconds_from_ms(gone_at_ms - stays_to_ms));
    double out = 1.0;
    if (light.fade_in_s > 0.0) out = std::min(out, since_s(time_ms) / light.fade_in_s);
    if (light.fade_out_s > 0.0) out = std::min(out, seconds_from_ms(own.to_ms - time_ms) / light.fade_out_s);
    return std::clamp(out, 0.0, 1.0);
}

Result<LightTime> light_time(const Mission& mission, std::size_t index, const LightStage& stage) {
    const Light& light = mission.lights[index];
    const auto range = keyframes_of(mission, light);
    if (!range) return range.error();
    const bool over_show = light.keyframe.empty();
    const TimeSpan lamps = lamp_time(stage.acts);
    const PlannedKeyframe &first = stage.keyframes[range->first], &last = stage.keyframes[range->last];
    LightTime time;
    time.own.from_ms = to_tick(light.start_s) + (over_show ? 0 : to_tick(first.stands_from_ms));
    time.own.to_ms = light.duration_s ? time.own.from_ms + to_tick(*light.duration_s)
                     : over_show      ? lamps.to_ms
                                      : to_tick(last.stands_to_ms);
    time.stays_to_ms = time.gone_at_ms = time.own.to_ms;
    const bool outlasts = light.effect == LightEffect::fade && light.fade_out_s == 0.0;
    if (outlasts && time.own.from_ms < time.own.to_ms) outlast(mission, stage, time.own.to_ms, lamps, time);
    time.lit = {std::max(time.own.from_ms, lamps.from_ms), std::min(time.gone_at_ms, lamps.to_ms)};
    if (time.lit.from_ms < time.lit.to_ms) return time;
    const std::string key = "light[" + std::to_string(index + 1) + "]";
    const bool empty = time.own.from_ms >= time.own.to_ms, late = time.own.from_ms >= lamps.to_ms;
    const bool passed = !over_show && first.stands_from_ms == last.stands_to_ms && !light.duration_s;
    const std::string what = late ? ": begins after the lamps' last light, at " + seconds(time.own.from_ms)
                             : passed
                                 ? ": its keyframe is passed without a stop; write a duration_s. It is passed at " +
                                       seconds(first.stands_from_ms)
                             : empty ? ": ends before it begins, at " + seconds(time.own.to_ms)
                                     : ": is over before lamps shine, at " + seconds(time.own.to_ms);
    return Error{ErrorCode::invalid_input,
                 mission.at(light.line, key + what + " s of the show; lamps shine from " + seconds(lamps.from_ms) +
                                            " to " + seconds(lamps.to_ms) + " s" +
                                            (over_show ? ""
                                                       : ", and \"" + light.keyframe + "\" stands from " +
                                                             seconds(first.stands_from_ms) + " to " +
                                                             seconds(last.stands_to_ms) + " s"))};
}

Passage passage_at(const LightStage& stage, const KeyframeRange& range, Millis time_ms) {
    std::size_t k = range.first;
    while (k < range.last && time_ms >= stage.keyframes[k + 1].stands_from_ms) ++k;
    const Millis leaves_ms = stage.keyframes[k].stands_to_ms;
    if (k == range.last || time_ms <= leaves_ms) return {k, k, 0.0};
    const Millis there_ms = stage.keyframes[k + 1].stands_from_ms;
    return {k, k + 1, static_cast<double>(time_ms - leaves_ms) / static_cast<double>(there_ms - leaves_ms)};
}

}  // namespace aerogram::planner
