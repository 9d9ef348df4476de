#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "export/verify_agreement.hpp"

namespace aerogram::exporter {
namespace {

constexpr double kMostSamples = 2e6;  ///< of all drones together
constexpr double kSampleEvery_s = 0.5, kFewestTimes = 40.0;
constexpr double kSteady = 0.01;  ///< a lamp that changes less in the window is compared

/// What a format keeps of lights: compared where the lamp is steady for the window, to that difference.
struct LightAccuracy {
    std::string_view format;
    double window_s = 0.0, allowed = 0.0;
};
constexpr std::array kKept{LightAccuracy{"skyc", 0.05, 0.02},    LightAccuracy{"skyb", 0.05, 0.02},
                           LightAccuracy{"preview", 0.05, 0.02}, LightAccuracy{"glb", 0.05, 0.02},
                           LightAccuracy{"vviz", 0.1, 0.02},     LightAccuracy{"csv", 0.6, 0.03},
                           LightAccuracy{"px4-csv", 0.6, 0.03}};

double difference(const Rgb& a, const Rgb& b) {
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

/// Whether a lamp keeps its colour from window_s before to window_s after.
bool is_steady(const std::vector<LightKey>& keys, double t_s, double window_s) {
    const Rgb color = light_at(keys, t_s);
    const bool changes = std::ranges::any_of(keys, [&](const LightKey& key) {
        return std::abs(static_cast<double>(key.time_ms) / 1000.0 - t_s) <= window_s;
    });
    return !changes && difference(color, light_at(keys, t_s - window_s)) <= kSteady &&
           difference(color, light_at(keys, t_s + window_s)) <= kSteady;
}

std::string described(std::size_t drone, double t_s, const Rgb& found, const Rgb& exact) {
    std::array<char, 200> text{};
    std::snprintf(text.data(), text.size(),
                  "drone %zu at %.2f s has another light than trajectories: %.3f %.3f %.3f, there %.3f %.3f %.3f",
                  drone + 1, t_s, found.r, found.g, found.b, exact.r, exact.g, exact.b);
    return text.data();
}

}  // namespace

Problems disagreement_of_lights(const RecordedShow& reference, const RecordedShow& show) {
    const auto kept = std::ranges::find(kKept, show.format, &LightAccuracy::format);
    if (kept == kKept.end() || reference.drones.size() != show.drones.size() || reference.format != "trajectories")
        return {};
    const double wanted =
        std::min(reference.duration_s / kSampleEvery_s, kMostSamples / static_cast<double>(show.drones.size()));
    const auto times = static_cast<std::size_t>(std::max(kFewestTimes, wanted));
    for (std::size_t d = 0; d < show.drones.size(); ++d) {
        const auto &exact = reference.drones[d].tracks.lights, &found = show.drones[d].tracks.lights;
        for (std::size_t k = 0; k < times; ++k) {
            const double t_s = reference.duration_s * ((static_cast<double>(k) + 0.5) / static_cast<double>(times));
            const Rgb a = light_at(exact, t_s), b = light_at(found, t_s);
            if (difference(a, b) > kept->allowed && is_steady(exact, t_s, kept->window_s))
                return {described(d, t_s, b, a)};
        }
    }
    return {};
}

}  // namespace aerogram::exporter
