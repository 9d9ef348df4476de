#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "geo/tracks.hpp"

/// A lamp's light as samples of a display colour, as CZML has it.
namespace aerogram::exporter {

/// 8-bit sRGB; between two samples the colour goes over, before the first and after the last it holds.
struct ColorSample {
    Millis time_ms = 0;
    Rgb8 color;
    bool operator==(const ColorSample&) const = default;
};

/// Jumps go over within the last millisecond before them. Times rise, from 0. Never empty.
[[nodiscard]] std::vector<ColorSample> color_samples(std::span<const LightKey> keys);

/// Keys on the 20 ms grid; what goes over within a millisecond is a jump. Properties: (1) of color_samples() the light
/// at any time but the last millisecond before a jump is the original's within 1.2/255, components linear
/// @param samples  times do not fall.
[[nodiscard]] std::vector<LightKey> light_keys(std::span<const ColorSample> samples);

}  // namespace aerogram::exporter
