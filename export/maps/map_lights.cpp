#include "export/maps/map_lights.hpp"

#include <algorithm>
#include <array>
#include <string>

namespace aerogram::exporter {
namespace {

constexpr Millis kGrid_ms = 20, kJump_ms = 1;

/// The nearest display colour.
Rgb8 srgb(const Rgb& linear) {
    const std::string hex = hex_from_rgb(linear);
    const auto digit = [&](std::size_t k) { return hex[k] <= '9' ? hex[k] - '0' : (hex[k] | 0x20) - 'a' + 10; };
    const auto byte = [&](std::size_t k) { return static_cast<std::uint8_t>(16 * digit(k) + digit(k + 1)); };
    return {byte(1), byte(3), byte(5)};
}

/// Linear light of each 8-bit sRGB value.
const std::array<double, 256>& linear_table() {
    static const std::array<double, 256> kTable = [] {
        constexpr std::string_view kDigits = "0123456789abcdef";
        std::array<double, 256> table{};
        for (std::size_t v = 0; v < table.size(); ++v) {
            const std::string two{kDigits[v / 16], kDigits[v % 16]};
            table[v] = rgb_from_hex("#" + two + two + two).value().r;
        }
        return table;
    }();
    return kTable;
}

Rgb linear(const Rgb8& c) {
    const auto& table = linear_table();
    return {table[c.r], table[c.g], table[c.b]};
}

}  // namespace

std::vector<ColorSample> color_samples(std::span<const LightKey> keys) {
    std::vector<ColorSample> samples{{0, {}}};
    bool fades = false, faded = false;  // the key before goes over to this one; the last sample ends such a fade
    for (const LightKey& key : keys) {
        const ColorSample next{key.time_ms, srgb(key.color)}, last = samples.back();
        if (next.time_ms > last.time_ms && fades) {
            samples.push_back(next);
            faded = true;
        } else if (next.time_ms > last.time_ms) {
            if (next.color != last.color || key.fade) {
                if (next.time_ms - kJump_ms > last.time_ms) samples.push_back({next.time_ms - kJump_ms, last.color});
                samples.push_back(next);
            }
            faded = false;
        } else {
            if (faded && next.color != last.color) {
                samples.back().time_ms = next.time_ms - kJump_ms;
                samples.push_back(next);
            } else {
                samples.back().color = next.color;
            }
            faded = false;
        }
        fades = key.fade;
    }
    return samples;
}

std::vector<LightKey> light_keys(std::span<const ColorSample> samples) {
    std::vector<LightKey> keys;
    for (std::size_t k = 0; k < samples.size(); ++k) {
        const ColorSample& sample = samples[k];
        const bool last = k + 1 == samples.size();
        const bool fade =
            !last && samples[k + 1].color != sample.color && samples[k + 1].time_ms - sample.time_ms > kJump_ms;
        const Millis time_ms = (std::max<Millis>(0, sample.time_ms) + kGrid_ms / 2) / kGrid_ms * kGrid_ms;
        const LightKey key{time_ms, linear(sample.color), fade};
        const bool nothing_new = !keys.empty() && !key.fade && !keys.back().fade && key.color == keys.back().color;
        if (!nothing_new) keys.push_back(key);
    }
    return keys;
}

}  // namespace aerogram::exporter
