#include "planner/light/lights.hpp"

#include <algorithm>
#include <atomic>
#include <memory>

#include "geo/contract.hpp"
#include "geo/units.hpp"
#include "planner/light/beam.hpp"
#include "planner/light/key_writer.hpp"

namespace aerogram::planner {
namespace {

constexpr std::size_t kMostCells = 12'000'000;  ///< of all pictures together
constexpr std::size_t kMostCellsEach = 512 * 512;

/// A lamp's light before any of ours.
class Beneath {
  public:
    explicit Beneath(const std::vector<LightKey>& keys) : keys_(keys) {}

    /// At a time not before `state_ms`, of the piece that runs then.
    [[nodiscard]] Rgb at(Millis time_ms, Millis state_ms) const {
        const auto next = std::ranges::upper_bound(keys_, state_ms, {}, &LightKey::time_ms);
        if (next == keys_.begin()) return {};
        const LightKey& key = *(next - 1);
        if (!key.fade || next == keys_.end()) return key.color;
        return mix(key.color, next->color,
                   static_cast<double>(time_ms - key.time_ms) / static_cast<double>(next->time_ms - key.time_ms));
    }
    /// The pieces from one time to another, as they are.
    void write(const TimeSpan& span, KeyWriter& out) const {
        for (Millis from_ms = span.from_ms; from_ms < span.to_ms;) {
            const auto next = std::ranges::upper_bound(keys_, from_ms, {}, &LightKey::time_ms);
            const Millis to_ms = next == keys_.end() ? span.to_ms : std::min(span.to_ms, next->time_ms);
            out.add_as_it_is({from_ms, to_ms, at(from_ms, from_ms), at(to_ms, from_ms)});
            from_ms = to_ms;
        }
    }

  private:
    const std::vector<LightKey>& keys_;
};

/// When the lights are looked at, and which shine from each of those times to the next.
struct Grid {
    std::vector<Millis> times_ms;
    /// From times_ms[first] to times_ms[last] the same lights shine.
    struct Stretch {
        std::size_t first = 0, last = 0;
        std::vector<std::size_t> lights;  ///< ascending; may be none
    };
    std::vector<Stretch> stretches;

    [[nodiscard]] std::size_t index_of(Millis time_ms) const {
        return static_cast<std::size_t>(std::ranges::lower_bound(times_ms, time_ms) - times_ms.begin());
    }
};

Grid grid_of(const std::vector<LightTime>& lights, const std::vector<Tracks>& tracks, Millis step_ms) {
    Grid grid;
    auto& times_ms = grid.times_ms;
    std::vector<Millis> borders_ms;
    for (const LightTime& light : lights) {
        borders_ms.insert(borders_ms.end(), {light.lit.from_ms, light.lit.to_ms});
        for (const Millis bend_ms : {light.own.to_ms, light.stays_to_ms})
            if (light.lit.from_ms < bend_ms && bend_ms < light.lit.to_ms) times_ms.push_back(bend_ms);
    }
    for (const Tracks& track : tracks)
        for (const LightKey& key : track.lights) times_ms.push_back(key.time_ms);
    const auto make_unique = [](std::vector<Millis>& values) {
        std::ranges::sort(values);
        values.erase(std::unique(values.begin(), values.end()), values.end());
    };
    make_unique(borders_ms);
    times_ms.insert(times_ms.end(), borders_ms.begin(), borders_ms.end());
    const auto shines = [](const LightTime& light, Millis time_ms) {
        return light.lit.from_ms <= time_ms && time_ms < light.lit.to_ms;
    };
    for (std::size_t b = 0; b + 1 < borders_ms.size(); ++b) {
        if (std::ranges::none_of(lights, [&](const LightTime& l) { return shines(l, borders_ms[b]); })) continue;
        for (Millis t = (borders_ms[b] / step_ms + 1) * step_ms; t < borders_ms[b + 1]; t += step_ms)
            times_ms.push_back(t);
    }
    make_unique(times_ms);
    for (std::size_t b = 0; b + 1 < borders_ms.size(); ++b) {
        Grid::Stretch stretch{grid.index_of(borders_ms[b]), grid.index_of(borders_ms[b + 1]), {}};
        for (std::size_t l = 0; l < lights.size(); ++l)
            if (shines(lights[l], borders_ms[b])) stretch.lights.push_back(l);
        grid.stretches.push_back(std::move(stretch));
    }
    return grid;
}

/// All lights of a show.
class Lighting {
  public:
    static Result<std::unique_ptr<Lighting>> of(const Mission& mission, const LightStage& stage,
                                                const std::vector<Tracks>& tracks, const Run& run) {
        auto out = std::make_unique<Lighting>(stage);
        std::vector<LightTime> times;
        std::size_t pictures = 0;
        for (std::size_t l = 0; l < mission.lights.size(); ++l) {
            auto time = light_time(mission, l, stage);
            if (!time) return time.error();
            times.push_back(*time);
            if (mission.lights[l].effect == LightEffect::image) pictures += mission.lights[l].images.size();
        }
        out->grid_ = grid_of(times, tracks, light_step_ms(mission.light_rate_hz));
        const std::size_t cells =
            std::clamp<std::size_t>(kMostCells / std::max<std::size_t>(1, pictures), 1, kMostCellsEach);
        for (std::size_t l = 0; l < mission.lights.size(); ++l) {
            std::vector<PictureLight> own;
            if (mission.lights[l].effect == LightEffect::image) {
                auto read = read_pictures(mission, l, cells);
                if (!read) return read.error();
                own = std::move(*read);
            }
            const std::size_t first = out->grid_.index_of(times[l].lit.from_ms);
            const std::size_t count = out->grid_.index_of(times[l].lit.to_ms) + 1 - first;
            out->first_.push_back(first);
            out->beams_.push_back(std::make_unique<Beam>(mission, l, stage, times[l],
                                                         std::span(out->grid_.times_ms).subspan(first, count),
                                                         std::move(own), run));
            if (run.stopped()) return stopped_error();
        }
        return out;
    }
    explicit Lighting(const LightStage& stage) : stage_(stage) {}

    [[nodiscard]] std::vector<LightKey> lit(DroneId drone, const std::vector<LightKey>& keys) const {
        const bool untouched = std::ranges::none_of(beams_, [&](const auto& beam) { return beam->is_for(drone); });
        if (untouched) return keys;
        const Beneath beneath(keys);
        const auto& times_ms = grid_.times_ms;
        KeyWriter out;
        Points track_m;
        TimeSpan idle{times_ms.front(), times_ms.front()};
        for (const Grid::Stretch& stretch : grid_.stretches) {
            std::vector<std::size_t> mine;
            std::ranges::copy_if(stretch.lights, std::back_inserter(mine),
                                 [&](std::size_t l) { return beams_[l]->is_for(drone); });
            if (mine.empty()) continue;
            beneath.write({idle.from_ms, times_ms[stretch.first]}, out);
            idle.from_ms = times_ms[stretch.last];
            if (std::ranges::any_of(mine, [&](std::size_t l) { return beams_[l]->asks_for_places(); }))
                follow(drone, stretch, track_m);
            const auto light_at = [&](std::size_t now, std::size_t state) {
                Rgb light = beneath.at(times_ms[now], times_ms[state]);
                for (const std::size_t l : mine) {
                    const auto track =
                        track_m.empty() ? std::span<const Vec3>() : std::span(track_m).subspan(first_[l]);
                    light = beams_[l]->over(light, drone, {now - first_[l], state - first_[l]}, track);
                }
                return light;
            };
            for (std::size_t i = stretch.first; i < stretch.last; ++i)
                out.add({times_ms[i], times_ms[i + 1], light_at(i, i), light_at(i + 1, i)});
        }
        idle.to_ms = times_ms.back();
        beneath.write(idle, out);
        return std::move(out).finished(idle.to_ms, beneath.at(idle.to_ms, idle.to_ms));
    }

  private:
    /// Where the plan has a drone at the times of a stretch.
    void follow(DroneId drone, const Grid::Stretch& stretch, Points& track_m) const {
        track_m.resize(grid_.times_ms.size());
        auto act = stage_.acts.begin();
        for (std::size_t i = stretch.first; i <= stretch.last; ++i) {
            const Millis now_ms = grid_.times_ms[i];
            while (act + 1 != stage_.acts.end() && (act + 1)->start_ms <= now_ms) ++act;
            track_m[i] = kinematics(*act, drone, seconds_from_ms(now_ms - act->start_ms)).position_m;
        }
    }

    LightStage stage_;
    Grid grid_;
    std::vector<std::unique_ptr<Beam>> beams_;
    std::vector<std::size_t> first_;  ///< of each beam's times in the grid's
};

}  // namespace

Result<std::vector<Tracks>> lit_tracks(const Mission& mission, const LightStage& stage, std::vector<Tracks> tracks,
                                       const Run& run) {
    if (mission.lights.empty() || tracks.empty()) return tracks;
    AEROGRAM_REQUIRE(stage.keyframes.size() == mission.keyframes.size(), stage.keyframes.size());
    const auto lighting = Lighting::of(mission, stage, tracks, run);
    if (!lighting) return lighting.error();
    std::atomic<std::size_t> keys{0};
    parallel_for(tracks.size(), run, "lights", [&](std::size_t d) {
        if (keys > kMostLightKeys) return;
        tracks[d].lights = (*lighting)->lit(DroneId(d), tracks[d].lights);
        keys += tracks[d].lights.size();
    });
    if (run.stopped()) return stopped_error();
    if (keys <= kMostLightKeys) return tracks;
    return Error{ErrorCode::invalid_input,
                 mission.at(mission.lights.front().line,
                            "light: the lights of this show need more than " + std::to_string(kMostLightKeys) +
                                " light keys; longer periods, shorter effects or a lower [lights] rate_hz need fewer")};
}

}  // namespace aerogram::planner
