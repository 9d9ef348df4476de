#pragma once
#include <cmath>

#include "geo/units.hpp"
#include "geo/vec3.hpp"

/// North, east, down about the show's origin.
namespace aerogram::exporter {

class NedFrame {
  public:
    /// @param heading_deg  of show +y, clockwise from true north.
    explicit NedFrame(double heading_deg)
        : heading_deg_(heading_deg), cos_(std::cos(radians(heading_deg))), sin_(std::sin(radians(heading_deg))) {}

    [[nodiscard]] Vec3 to_ned(const Vec3& show) const {
        return {show.y * cos_ - show.x * sin_, show.y * sin_ + show.x * cos_, -show.z};
    }
    [[nodiscard]] Vec3 from_ned(const Vec3& ned) const {
        return {ned.y * cos_ - ned.x * sin_, ned.x * cos_ + ned.y * sin_, -ned.z};
    }
    /// Degrees clockwise from north, in [0, 360). @param yaw_rad  counter-clockwise from show +y.
    [[nodiscard]] double to_compass_deg(double yaw_rad) const {
        const double deg = std::fmod(heading_deg_ - degrees(yaw_rad), 360.0);
        return deg < 0.0 ? deg + 360.0 : deg;
    }
    /// In (-pi, pi]. @param compass_deg  clockwise from north.
    [[nodiscard]] double from_compass_deg(double compass_deg) const {
        const double deg = std::remainder(heading_deg_ - compass_deg, 360.0);
        return radians(deg == -180.0 ? 180.0 : deg);
    }

  private:
    double heading_deg_, cos_, sin_;
};

}  // namespace aerogram::exporter
