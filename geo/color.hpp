#pragma once
#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>

#include "geo/result.hpp"

namespace aerogram {

/// Light as a lamp emits it: linear RGB, each in [0, 1].
struct Rgb {
    double r = 0.0, g = 0.0, b = 0.0;
    constexpr auto operator<=>(const Rgb&) const = default;
};

/// Between two lights, share t in [0, 1], in linear light.
[[nodiscard]] constexpr Rgb mix(const Rgb& from, const Rgb& to, double t) {
    return {from.r + (to.r - from.r) * t, from.g + (to.g - from.g) * t, from.b + (to.b - from.b) * t};
}

/// The nearest light that a lamp can emit: sums of shares may miss [0, 1] by rounding.
[[nodiscard]] constexpr Rgb clamped(const Rgb& c) {
    return {std::clamp(c.r, 0.0, 1.0), std::clamp(c.g, 0.0, 1.0), std::clamp(c.b, 0.0, 1.0)};
}

/// "#rgb" or "#rrggbb" (sRGB) as linear light. Errors: invalid_input otherwise.
Result<Rgb> rgb_from_hex(std::string_view srgb_hex);
/// The nearest "#rrggbb" (sRGB).
std::string hex_from_rgb(const Rgb& linear);

/// An 8-bit linear lamp value, rounded; components outside [0, 1] are clamped.
struct Rgb8 {
    std::uint8_t r = 0, g = 0, b = 0;
    constexpr auto operator<=>(const Rgb8&) const = default;
};
[[nodiscard]] Rgb8 quantised(const Rgb& linear);
[[nodiscard]] constexpr Rgb from_8bit(const Rgb8& c) {
    return {c.r / 255.0, c.g / 255.0, c.b / 255.0};
}

}  // namespace aerogram
