#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "geo/tracks.hpp"

namespace aerogram::exporter {

/// A lamp's colour at a frame.
struct LightSample {
    std::int64_t frame = 0;
    Rgb8 color;
    bool operator==(const LightSample&) const = default;
};

/// A lamp's track as samples at frames, for readers that hold a sample's colour until the next, and for those that fade
/// to it alike: a colour that stays has a sample at its last frame as well, a fade one every ten frames or 32 in all.
/// Properties: (1) the first sample is at frame 0; frames rise (2) for readers that fade, every colour is within 0.5 /
/// 255 of the track, except in the frame before a jump; keys between frames count at the nearest (3) no sample lies on
/// the line between its neighbours where that line is level.
[[nodiscard]] std::vector<LightSample> light_samples(std::span<const LightKey> keys, Millis frame_ms);

}  // namespace aerogram::exporter
