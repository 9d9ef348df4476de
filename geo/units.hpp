#pragma once
#include <numbers>

namespace aerogram {

inline constexpr double kPi = std::numbers::pi;
[[nodiscard]] constexpr double radians(double deg) { return deg * (kPi / 180.0); }
[[nodiscard]] constexpr double degrees(double rad) { return rad * (180.0 / kPi); }
[[nodiscard]] constexpr double seconds_from_ms(long long ms) { return static_cast<double>(ms) / 1000.0; }

}  // namespace aerogram
