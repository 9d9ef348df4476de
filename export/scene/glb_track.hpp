#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "export/outgoing/fitted.hpp"
#include "geo/tracks.hpp"

/// What of one drone stands in the binary chunk of a GLB file.
namespace aerogram::exporter {

struct GlbTrack {
    std::vector<Millis> times_ms;  ///< of the keys, rising
    std::string values;            ///< a key: tangent in, place, tangent out; three floats each, glTF frame, m and m/s
};

/// The keys of a flight: one where two pieces meet, and the two ends. A cubic spline key by key is the same curve.
[[nodiscard]] GlbTrack glb_track(const Fitted& fitted);

inline constexpr std::size_t kGlbKeyBytes = 36, kGlbLightBytes = 8;

/// A light key a row: uint32 time in ms, red, green, blue (8-bit linear), 1 where it fades to the next.
void append_glb_lights(std::string& out, const std::vector<LightKey>& keys);

}  // namespace aerogram::exporter
