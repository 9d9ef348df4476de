#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "geo/color.hpp"

namespace aerogram {

/// Show time in whole milliseconds; 0 is the first take-off.
using Millis = std::int64_t;

/// From time_ms on the lamp shows `color`; with `fade` it goes linearly to the next key's colour, else it stays until there.
struct LightKey {
    Millis time_ms = 0;  ///< a multiple of 20
    Rgb color;
    bool fade = false;
    bool operator==(const LightKey&) const = default;
};

/// Yaw in the show frame, radians counter-clockwise from +y seen from above; linear between keys, held outside.
struct YawKey {
    Millis time_ms = 0;
    double yaw_rad = 0.0;
    bool operator==(const YawKey&) const = default;
};

/// A payload channel (a pyro igniter, a smoke canister) switched on or off.
struct PayloadEvent {
    Millis time_ms = 0;
    int channel = 0;
    bool on = true;
    bool operator==(const PayloadEvent&) const = default;
};

/// A named moment for lights, music and ground equipment.
struct Cue {
    Millis time_ms = 0;
    std::string name;
    bool operator==(const Cue&) const = default;
};

/// What one drone does beside moving; keys in time order, times not decreasing.
struct Tracks {
    std::vector<LightKey> lights;
    std::vector<YawKey> yaw;
    std::vector<PayloadEvent> events;
    bool operator==(const Tracks&) const = default;
};

/// The lamp's colour at t_s seconds; dark before the first key.
[[nodiscard]] Rgb light_at(std::span<const LightKey> keys, double t_s);
/// Yaw at t_s seconds, radians; 0 without keys.
[[nodiscard]] double yaw_at(std::span<const YawKey> keys, double t_s);

}  // namespace aerogram
