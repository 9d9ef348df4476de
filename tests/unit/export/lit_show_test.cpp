#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "export/exact/show_hash.hpp"
#include "export/formats.hpp"
#include "export/skybrush/light_program.hpp"
#include "geo/units.hpp"
#include "planner/light/lights.hpp"
#include "tests/unit/export/fixed_show.hpp"
#include "tests/unit/export/written_files.hpp"

namespace aerogram::exporter {
namespace {

/// The fixed show under a storm of lights: thousands of keys a drone, with jumps and fades that end in one.
planner::FlightPlan stormy_show() {
    planner::FlightPlan plan = fixed::show();
    planner::Mission mission;
    mission.light_rate_hz = 50.0;
    for (const planner::PlannedKeyframe& keyframe : plan.keyframes) {
        mission.keyframes.emplace_back();
        mission.keyframes.back().name = keyframe.name;
    }
    for (const auto effect :
         {planner::LightEffect::pulse, planner::LightEffect::sparkle, planner::LightEffect::sweep}) {
        planner::Light light;
        light.effect = effect;
        light.colors = {{1.0, 0.1, 0.3}, {0.05, 0.9, 0.6}};
        light.period_s = effect == planner::LightEffect::pulse ? 0.3 : 0.5;
        light.blend = effect == planner::LightEffect::sweep ? planner::LightBlend::add : planner::LightBlend::replace;
        light.opacity = 0.8;
        mission.lights.push_back(light);
    }
    auto lit = planner::lit_tracks(mission, {plan.keyframes, plan.acts, {}}, std::move(plan.tracks), Run{});
    plan.tracks = std::move(lit).value();
    return plan;
}

double apart(const Rgb& a, const Rgb& b) {
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

TEST(LitShow, HasHundredsOfKeysThatLightProgramsKeepWithinAnEightBitStep) {
    const planner::FlightPlan plan = stormy_show();
    for (const Tracks& tracks : plan.tracks) {
        EXPECT_GT(tracks.lights.size(), 500U);
        const auto decoded = decoded_light_program(light_program(tracks.lights, plan.duration_ms()));
        ASSERT_TRUE(decoded.ok()) << decoded.error().message;
        for (Millis t_ms = 0; t_ms < plan.duration_ms(); t_ms += 7) {
            const double t_s = seconds_from_ms(t_ms);
            ASSERT_LE(apart(light_at(tracks.lights, t_s), light_at(*decoded, t_s)), 1.0 / 255.0) << t_s;
        }
    }
}

TEST(LitShow, EveryFormatWithLightsBringsThemBack) {
    const planner::FlightPlan plan = stormy_show();
    for (const std::string name : {"trajectories", "skyc", "glb", "csv", "preview"}) {
        const Format* format = find_format(name);
        ASSERT_NE(format, nullptr) << name;
        const RecordedShow show = read_back(*format, written_files(*format, plan, {show_hash(plan), true}));
        ASSERT_EQ(show.drones.size(), plan.drones()) << name;
        for (std::size_t d = 0; d < plan.drones(); ++d) {
            const auto& keys = show.drones[d].tracks.lights;
            ASSERT_FALSE(keys.empty()) << name;
            if (name == "csv") continue;  // rows of its own rate
            for (Millis t_ms = 0; t_ms < plan.duration_ms(); t_ms += 13) {
                const double t_s = seconds_from_ms(t_ms);
                ASSERT_LE(apart(light_at(plan.tracks[d].lights, t_s), light_at(keys, t_s)), 1.0 / 255.0)
                    << name << ' ' << t_s;
            }
        }
    }
}

}  // namespace
}  // namespace aerogram::exporter
