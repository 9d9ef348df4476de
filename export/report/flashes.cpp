#include <algorithm>
#include <cmath>

#include "export/report/parts.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

// WCAG 2.2, definition of "general flash" and success criterion 2.3.1.
constexpr double kChange = 0.1, kDarkerBelow = 0.8, kMost_hz = 3.0;
constexpr Millis kGrid_ms = 20;
constexpr double kSame = 1e-9;

double luminance(const Rgb& c) {
    return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
}

/// A lamp's luminance from change to change.
std::vector<Luminance> of_lamp(const std::vector<LightKey>& keys) {
    std::vector<Luminance> values{{0.0, 0.0}};
    for (std::size_t k = 0; k < keys.size(); ++k) {
        const double t_s = seconds_from_ms(keys[k].time_ms);
        const bool fades_to = k > 0 && keys[k - 1].fade;
        if (!fades_to) values.push_back({t_s, values.back().value});
        values.push_back({t_s, luminance(keys[k].color)});
    }
    return values;
}

double most_in_a_second(const std::vector<LightKey>& keys) {
    std::size_t most = 0, first = 0;
    for (std::size_t k = 0; k < keys.size(); ++k) {
        while (keys[k].time_ms - keys[first].time_ms >= 1000) ++first;
        most = std::max(most, k - first + 1);
    }
    return static_cast<double>(most);
}

/// The sum of lamps' luminances on the grid of light times, kept as what changes there.
class FleetLight {
  public:
    explicit FleetLight(Millis duration_ms)
        : jump_(static_cast<std::size_t>(duration_ms / kGrid_ms) + 2), slope_(jump_.size()) {}

    void add(const std::vector<LightKey>& keys) {
        double now = 0.0;
        for (std::size_t k = 0; k < keys.size(); ++k) {
            const double to = luminance(keys[k].color);
            const std::size_t at = step(keys[k].time_ms);
            jump_[at] += to - now;
            now = to;
            if (!keys[k].fade || k + 1 == keys.size()) continue;
            const std::size_t end = step(keys[k + 1].time_ms);
            const double next = luminance(keys[k + 1].color);
            if (end <= at) continue;
            const double by = (next - to) / static_cast<double>(end - at);
            slope_[at] += by;
            slope_[end] -= by;
            now = next;
        }
    }
    void add(const FleetLight& other) {
        for (std::size_t k = 0; k < jump_.size(); ++k) jump_[k] += other.jump_[k], slope_[k] += other.slope_[k];
    }
    [[nodiscard]] std::vector<Luminance> mean(std::size_t lamps) const {
        std::vector<Luminance> values;
        double now = 0.0, slope = 0.0;
        const auto put = [&](std::size_t k) {
            values.push_back({static_cast<double>(k) * 0.001 * kGrid_ms, now / static_cast<double>(lamps)});
        };
        for (std::size_t k = 0; k < jump_.size(); ++k) {
            now += slope;
            put(k);
            if (jump_[k] != 0.0) {
                now += jump_[k];
                put(k);
            }
            slope += slope_[k];
        }
        return values;
    }

  private:
    [[nodiscard]] std::size_t step(Millis t_ms) const {
        return static_cast<std::size_t>(std::clamp<Millis>(t_ms / kGrid_ms, 0, static_cast<Millis>(jump_.size()) - 1));
    }
    std::vector<double> jump_, slope_;
};

}  // namespace

Flashes flashes(const std::vector<Luminance>& values) {
    if (values.empty()) return {};
    std::vector<double> changes_s;
    Luminance low = values.front(), high = low;
    int last = 0;  // the direction of the last change that counts
    for (const Luminance& v : values) {
        if (v.value < low.value) low = v;
        if (v.value > high.value) high = v;
        // A change counts at its end; the extremes then start again from there.
        if (v.value - low.value >= kChange - kSame && low.value < kDarkerBelow) {
            if (last != 1) changes_s.push_back(v.time_s);
            last = 1;
            low = high = v;
        } else if (high.value - v.value >= kChange - kSame && v.value < kDarkerBelow) {
            if (last != -1) changes_s.push_back(v.time_s);
            last = -1;
            low = high = v;
        }
    }
    Flashes most;
    std::size_t first = 0;
    for (std::size_t k = 0; k < changes_s.size(); ++k) {
        while (changes_s[k] - changes_s[first] >= 1.0 - kSame) ++first;
        const double hz = 0.5 * static_cast<double>(k - first + 1);
        if (hz > most.most_hz) most = {hz, changes_s[first]};
    }
    return most;
}

ReportLights report_lights(const OutgoingShow& show, const Run& run) {
    constexpr std::size_t kLampsAPart = 512;
    struct Part {
        ReportLights lights;
        FleetLight fleet;
    };
    const std::size_t lamps = show.drones();
    std::vector<Part> parts((lamps + kLampsAPart - 1) / kLampsAPart, {{}, FleetLight(show.facts().duration_ms)});
    parallel_for(parts.size(), run, "counting flashes", [&](std::size_t p) {
        for (std::size_t d = p * kLampsAPart; d < std::min(lamps, (p + 1) * kLampsAPart); ++d) {
            const std::vector<LightKey>& keys = show.tracks(d).lights;
            ReportLights& lights = parts[p].lights;
            lights.keys += keys.size();
            lights.most_keys_per_s = std::max(lights.most_keys_per_s, most_in_a_second(keys));
            lights.fastest_flash_hz = std::max(lights.fastest_flash_hz, flashes(of_lamp(keys)).most_hz);
            parts[p].fleet.add(keys);
        }
    });
    ReportLights all;
    for (std::size_t p = 0; p < parts.size(); ++p) {
        all.keys += parts[p].lights.keys;
        all.most_keys_per_s = std::max(all.most_keys_per_s, parts[p].lights.most_keys_per_s);
        all.fastest_flash_hz = std::max(all.fastest_flash_hz, parts[p].lights.fastest_flash_hz);
        if (p > 0) parts[0].fleet.add(parts[p].fleet);
    }
    if (parts.empty()) return all;
    const Flashes fleet = flashes(parts[0].fleet.mean(lamps));
    all.fleet_flash_hz = fleet.most_hz;
    all.fleet_flash_s = fleet.time_s;
    all.warning = fleet.most_hz > kMost_hz;
    return all;
}

}  // namespace aerogram::exporter
