#include "geo/color.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>

namespace aerogram {
namespace {

// The sRGB transfer curve, IEC 61966-2-1.
double linear_from_srgb(double s) {
    return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}
double srgb_from_linear(double v) {
    return v <= 0.0031308 ? v * 12.92 : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055;
}

std::uint8_t byte_from_unit(double v) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(v, 0.0, 1.0) * 255.0));
}

std::optional<int> hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return std::nullopt;
}

bool has_numbers(const Rgb& c) {
    return !std::isnan(c.r) && !std::isnan(c.g) && !std::isnan(c.b);
}

}  // namespace

Result<Rgb> rgb_from_hex(std::string_view srgb_hex) {
    const Error error{ErrorCode::invalid_input,
                      "\"" + std::string(srgb_hex) + "\" is not a colour: must be \"#rgb\" or \"#rrggbb\""};
    if ((srgb_hex.size() != 4 && srgb_hex.size() != 7) || srgb_hex.front() != '#') return error;
    const std::size_t digits = srgb_hex.size() == 4 ? 1 : 2;
    std::array<double, 3> linear{};
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const auto high = hex_digit(srgb_hex[1 + channel * digits]);
        const auto low = hex_digit(srgb_hex[channel * digits + digits]);  // of "#rgb" the same digit
        if (!high || !low) return error;
        linear[channel] = linear_from_srgb((*high * 16 + *low) / 255.0);
    }
    return Rgb{linear[0], linear[1], linear[2]};
}

std::string hex_from_rgb(const Rgb& linear) {
    AEROGRAM_REQUIRE(has_numbers(linear), linear.r, linear.g, linear.b);
    std::string text = "#";
    for (const double component : {linear.r, linear.g, linear.b}) {
        std::array<char, 3> digits{};
        const unsigned value = byte_from_unit(srgb_from_linear(std::clamp(component, 0.0, 1.0)));
        std::snprintf(digits.data(), digits.size(), "%02x", value);
        text += digits.data();
    }
    return text;
}

Rgb8 quantised(const Rgb& linear) {
    AEROGRAM_REQUIRE(has_numbers(linear), linear.r, linear.g, linear.b);
    return {byte_from_unit(linear.r), byte_from_unit(linear.g), byte_from_unit(linear.b)};
}

}  // namespace aerogram
