#pragma once
#include <array>
#include <vector>

#include "export/outgoing/fitted.hpp"
#include "geo/limits.hpp"
#include "planner/motion/act.hpp"

/// An act's curve on fewer, longer cubics, for formats whose rounding would make noise of accelerations on short ones
/// (DESIGN.md 3): C1 Hermite pieces of at least half a second.
namespace aerogram::exporter {

inline constexpr double kFitPosition_m = 0.02, kFitSpeed_mps = 0.15;
inline constexpr double kFitAccelerationShare = 0.25;  ///< of the acceleration limit
/// The most a writer lets through, else it refuses: the three constants above, and as much less in position as two
/// drones' fits and millimetres need to stay within the export margin together. Half-second cubics need this much on
/// the sharpest legal flights (S-curve of 5 m at 2 m/s² and 8 m/s³: 0.43 m/s²; trapezoid of 45 m: 0.11 m/s).
[[nodiscard]] FitError fit_bound(const Limits& limits);
/// Where the fitter stops refining: 4 mm, 0.02 m/s, 0.03 m/s², and within the bound.
[[nodiscard]] FitError fit_aim(const Limits& limits);

/// Fits all drones of one act, which must outlive the fitter.
///
/// The act's time is cut into n near-equal pieces of whole milliseconds, each >= kShortestPieceMs (one piece when the
/// act is shorter); each takes position and velocity of the act at its ends. n is the smallest of 1, 2, 3, 4, 6, 8, 12,
/// ..., the largest possible, that meets fit_aim; the largest when none does.
/// Properties: (1) position and velocity are continuous and exact where pieces meet
/// (2) the error is an upper bound of a dense sampling's, at most twice it
/// (3) a drone that stands gives one standing piece (4) vertical motion stays vertical
/// (5) pieces that are the act's knot intervals are exact.
/// Accuracy: the error is the control polygon of the difference on every stretch where both curves are one cubic.
class ActFitter {
  public:
    ActFitter(const planner::Act& act, const Limits& limits);
    [[nodiscard]] Fitted fit(DroneId drone) const;

  private:
    struct Misfit {
        double position_m = 0.0, speed_mps = 0.0, exact_peak_mps2 = 0.0, fit_peak_mps2 = 0.0;
    };
    /// One drone's cubics of an act, a knot interval each, and the largest acceleration on them.
    struct Exact {
        std::vector<std::array<Vec3, 4>> cubics;
        double peak_mps2 = 0.0;
    };
    [[nodiscard]] static Exact exact_curve(const planner::Act& act, DroneId drone);
    /// @param give_up_m  a misfit beyond this ends the measurement: what comes back says no more than "too much".
    [[nodiscard]] static Misfit measured(const planner::Act& act, DroneId drone, const Exact& exact,
                                         const std::vector<Millis>& bounds, double give_up_m);
    [[nodiscard]] FitError error_of(const Misfit& misfit) const;
    /// @param exact  of the drone; not looked at for straight acts.
    [[nodiscard]] FitError error_of(DroneId drone, const Exact& exact, std::size_t choice) const;

    const planner::Act& act_;
    FitError aim_;
    double acceleration_limit_mps2_;
    std::vector<std::vector<Millis>> choices_;  ///< act-local piece boundaries, finer and finer
    std::vector<Misfit> unit_misfits_;          ///< straight acts: of a flight of 1 m, one a choice
};

}  // namespace aerogram::exporter
