#include "geo/units.hpp"
#include "planner/mission/sections.hpp"

namespace aerogram::planner {
namespace {

// `wave = { amplitude_m = [0, 2, 0], direction = [1, 0, 0], length_m = 20, cycles = 2 }`.
std::optional<Wave> read_wave(TableReader& motion) {
    auto in = motion.table("wave");
    if (!in) return std::nullopt;
    Wave wave;
    const auto amplitude_m = in->vec3("amplitude_m");
    if (amplitude_m && *amplitude_m == Vec3{}) in->bad("amplitude_m", "must have a length");
    wave.amplitude_m = amplitude_m.value_or(wave.amplitude_m);
    wave.direction = read_direction(*in, "direction").value_or(wave.direction);
    wave.length_m = in->number("length_m", more_than(0.0, 10000.0)).value_or(wave.length_m);
    wave.cycles = in->number("cycles", more_than(0.0, 1000.0)).value_or(wave.cycles);
    in->finish();
    return wave;
}

}  // namespace

HoldMotion read_motion(TableReader& in) {
    HoldMotion out;
    auto motion = in.table("motion");
    if (!motion) return out;
    out.spin_rad = radians(motion->number("spin_deg", {-36000.0, 36000.0}).value_or(0.0));
    out.drift_m = motion->vec3("drift_m").value_or(Vec3{});
    out.scale = motion->number("scale", more_than(0.0, 100.0)).value_or(out.scale);
    out.wave = read_wave(*motion);
    motion->finish();
    return out;
}

std::vector<Keyframe> frames_of(const Keyframe& keyframe, const Animation& animation) {
    std::vector<Keyframe> out;
    // A clip's last instant is where its next pass begins; numbered files are all different.
    const bool shared = std::holds_alternative<MeshSource>(keyframe.parts.front().source);
    const std::size_t pass = animation.frames - (shared ? 1 : 0);
    const std::size_t count = animation.repeat * pass + (shared ? 1 : 0);
    const auto instant = [&](std::size_t f) { return shared && f > 0 ? (f - 1) % pass + 1 : f % animation.frames; };
    for (std::size_t f = 0; f < count; ++f) {
        Keyframe frame = keyframe;
        frame.clip = keyframe.name;
        frame.name = keyframe.name + " " + std::to_string(f + 1);
        for (Part& part : frame.parts) {
            if (auto* svg = std::get_if<SvgSource>(&part.source); svg && svg->frame) svg->frame->index = instant(f);
            if (auto* mesh = std::get_if<MeshSource>(&part.source); mesh && mesh->frame)
                mesh->frame->index = instant(f);
        }
        if (f > 0) {
            frame.at_s.reset();
            frame.arrive = {};
            frame.arrive.method = Method::flow;
            frame.arrive.assign = Assign::slots;
            frame.arrive.min_separation_m = keyframe.arrive.min_separation_m;
            frame.arrive.separation = keyframe.arrive.separation;
            frame.arrive.line = keyframe.line;
            if (animation.duration_s)
                frame.arrive.duration_s = *animation.duration_s / static_cast<double>(animation.frames - 1);
        }
        if (f + 1 < count) {
            frame.hold_s = 0.0;
            frame.motion = {};
        }
        out.push_back(std::move(frame));
    }
    return out;
}

}  // namespace aerogram::planner
