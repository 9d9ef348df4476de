#pragma once
#include <array>
#include <vector>

#include "planner/motion/act.hpp"

/// An act's curve on fewer, longer cubics, for formats whose rounding would make noise of accelerations on short ones
/// (DESIGN.md 3): C1 Hermite pieces of at least half a second.
namespace aerogram::exporter {

inline constexpr Millis kShortestPieceMs = 500;

/// What a refitted curve may differ from the act's by, before any rounding.
struct FitError {
    double position_m = 0.0;         ///< at every instant
    double speed_mps = 0.0;          ///< of the velocity, at every instant
    double acceleration_mps2 = 0.0;  ///< its largest acceleration above the exact curve's largest in the same act

    [[nodiscard]] bool within(const FitError& bound) const {
        return position_m <= bound.position_m && speed_mps <= bound.speed_mps &&
               acceleration_mps2 <= bound.acceleration_mps2;
    }
};
/// The fitter stops refining here.
inline constexpr FitError kFitAim{0.004, 0.02, 0.03};
/// Writers guarantee this, or refuse. The acceleration is that of half-second cubics on the shortest acts (a climb of 3 m in 3 s
/// at a jerk of 8 m/s³ is off by 0.27 m/s²).
inline constexpr FitError kFitBound{0.01, 0.1, 0.5};

struct FittedPiece {
    Millis start_ms = 0, duration_ms = 0;  ///< show time
    bool stands = false;                   ///< all four controls are one point
    std::array<Vec3, 4> controls_m{};
};
struct Fitted {
    std::vector<FittedPiece> pieces;  ///< without gaps over the act
    FitError error;                   ///< sound upper bounds
};

/// Fits all drones of one act.
///
/// The act's time is cut into n near-equal pieces of whole milliseconds, each >= kShortestPieceMs (one piece when the
/// act is shorter); each takes position and velocity of the act at its ends. n is the smallest of 1, 2, 3, 4, 6, 8, 12,
/// ..., the largest possible, that meets kFitAim; the largest when none does. When the pieces are the act's knot
/// intervals the fit is exact. Properties: (1) position and velocity are continuous and exact where pieces meet (2) the
/// error is an upper bound of a dense sampling's (3) a drone that stands gives one standing piece (4) vertical motion
/// stays vertical. Accuracy: the error is the control polygon of the difference on every stretch where both curves are
/// one cubic.
class ActFitter {
  public:
    explicit ActFitter(const planner::Act& act);
    [[nodiscard]] Fitted fit(DroneId drone) const;

  private:
    [[nodiscard]] FitError error_of(DroneId drone, std::size_t choice) const;

    const planner::Act& act_;
    std::vector<std::vector<Millis>> choices_;  ///< act-local piece boundaries, finer and finer
    std::vector<FitError> unit_errors_;         ///< straight acts: of a flight of 1 m, one a choice
};

}  // namespace aerogram::exporter
