#pragma once
#include <string>
#include <utility>
#include <vector>

#include "geo/tracks.hpp"
#include "planner/light/lights.hpp"
#include "planner/mission/mission.hpp"

/// Small timed shows made by hand for the tests of lights.
namespace aerogram::planner::test {

inline constexpr Rgb kRed{1, 0, 0}, kGreen{0, 1, 0}, kBlue{0, 0, 1}, kWhite{1, 1, 1}, kDark{};

/// A row of drones, one metre apart, white: they take off for 10 s, fly for 10 s to "row", where they stand from 20 s
/// to 30 s; fly 10 s to "high", 20 m higher and reversed, where they stand from 40 s to 50 s; fly home for 10 s and
/// land from 60 s to 70 s.
struct SmallShow {
    Mission mission;
    std::vector<PlannedKeyframe> keyframes;
    std::vector<Act> acts;
    std::vector<Tracks> tracks;

    explicit SmallShow(std::size_t drones = 11) {
        mission.file = "show.toml";
        Points pads_m, row_m, high_m;
        std::vector<SlotId> same, reversed;
        for (std::size_t d = 0; d < drones; ++d) {
            const double x_m = static_cast<double>(d);
            pads_m.emplace_back(x_m, 0, 0);
            row_m.emplace_back(x_m, 0, 20);
            high_m.emplace_back(x_m, 0, 40);
            same.emplace_back(d);
            reversed.emplace_back(drones - 1 - d);
        }
        Points high_by_drone_m(high_m.rbegin(), high_m.rend());
        const std::vector<Rgb> white(drones, kWhite);
        keyframes = {{"row", row_m, white, same, 20'000, 30'000}, {"high", high_m, white, reversed, 40'000, 50'000}};
        for (const char* name : {"row", "high"}) {
            mission.keyframes.emplace_back();
            mission.keyframes.back().name = name;
        }
        add("take-off", ActRole::takeoff, Hold{pads_m});
        add("to row", ActRole::transit, Hold{row_m});
        add("row", ActRole::hold, Hold{row_m});
        add("to high", ActRole::transit, straight(row_m, high_by_drone_m));
        add("high", ActRole::hold, Hold{high_by_drone_m});
        add("return", ActRole::transit, Hold{row_m});
        add("landing", ActRole::landing, Hold{pads_m});
        tracks.assign(drones, {{{0, kDark, false},
                                {10'000, kDark, true},
                                {20'000, kWhite, false},
                                {30'000, kWhite, true},
                                {40'000, kWhite, false},
                                {50'000, kWhite, true},
                                {60'000, kDark, false}},
                               {},
                               {}});
    }

    [[nodiscard]] LightStage stage() const { return {keyframes, acts, mission.groups}; }
    [[nodiscard]] std::vector<Tracks> lit(unsigned threads = 1) const {
        auto out = lit_tracks(mission, stage(), tracks, Run{{}, nullptr, threads});
        return std::move(out).value();
    }
    [[nodiscard]] Error refusal() const { return lit_tracks(mission, stage(), tracks, Run{}).error(); }
    Light& add_light(LightEffect effect, std::string keyframe, std::vector<Rgb> colors) {
        Light light;
        light.effect = effect;
        light.keyframe = std::move(keyframe);
        light.colors = std::move(colors);
        light.line = 12;
        mission.lights.push_back(std::move(light));
        return mission.lights.back();
    }

  private:
    void add(std::string name, ActRole role, Motion motion) {
        const Millis start_ms = acts.empty() ? 0 : acts.back().end_ms();
        acts.push_back({std::move(name), role, Timing::fixed, start_ms, 10'000, std::move(motion)});
    }
    static Motion straight(const Points& from_m, const Points& to_m) {
        return Straight{from_m, to_m, {0, 0, 0, 0.25, 0.5, 0.75, 1, 1, 1}};
    }
};

inline Rgb shown(const std::vector<Tracks>& tracks, std::size_t drone, double t_s) {
    return light_at(tracks[drone].lights, t_s);
}

}  // namespace aerogram::planner::test
