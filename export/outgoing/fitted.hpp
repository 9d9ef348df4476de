#pragma once
#include <array>
#include <vector>

#include "geo/tracks.hpp"
#include "geo/vec3.hpp"

namespace aerogram::exporter {

/// Curve formats keep pieces at least this long: on shorter ones rounding would make noise of accelerations.
inline constexpr Millis kShortestPieceMs = 500;

/// What a refitted curve may differ from the exact one by, before any rounding.
struct FitError {
    double position_m = 0.0;         ///< at every instant
    double speed_mps = 0.0;          ///< of the velocity, at every instant
    double acceleration_mps2 = 0.0;  ///< of the largest acceleration, above the limit or the exact curve's if larger

    [[nodiscard]] bool within(const FitError& bound) const {
        return position_m <= bound.position_m && speed_mps <= bound.speed_mps &&
               acceleration_mps2 <= bound.acceleration_mps2;
    }
};

struct FittedPiece {
    Millis start_ms = 0, duration_ms = 0;  ///< show time
    bool stands = false;                   ///< all four controls are one point
    std::array<Vec3, 4> controls_m{};
};
struct Fitted {
    std::vector<FittedPiece> pieces;  ///< without gaps
    FitError error;                   ///< sound upper bounds
};

}  // namespace aerogram::exporter
