#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geo/airspace.hpp"
#include "geo/ids.hpp"
#include "geo/limits.hpp"
#include "geo/run.hpp"
#include "geo/show_frame.hpp"
#include "planner/motion/act.hpp"
#include "planner/motion/plane_rules.hpp"
#include "planner/motion/timing.hpp"

namespace aerogram::planner {

/// Where and when two drones are closest.
struct Encounter {
    DroneId first, second;
    double time_s = 0.0;      ///< act-local
    double distance_m = 0.0;  ///< attained there, in the separation metric: the true minimum is not above this
};

/// Continuous-time separation of an act: lower_bound_m <= true minimum <= closest.distance_m, over all pairs that are
/// not excused (see certify).
struct SeparationBound {
    double lower_bound_m = 0.0;
    std::optional<Encounter> closest;  ///< absent with fewer than two drones
};

/// Separations are judged to this: a formation at exactly the required spacing is not refused for its last digits.
inline constexpr double kSeparationTolerance_m = 1e-5;
[[nodiscard]] inline bool keeps(const SeparationBound& bound, double required_m) {
    return bound.lower_bound_m >= required_m - kSeparationTolerance_m;
}

/// Bounds the smallest distance of any pair at any instant of the act, in continuous time.
/// Holds and straight acts: exactly, from the segments along which differences run. Lattices: convex hulls of the
/// difference's control points (z divided by the downwash), one separating direction, bisection while inconclusive. The
/// candidates come from a tree of the moving points, never from all pairs of a sane map; wild maps cost more.
/// @param beyond_m  distances above this need not be resolved: the answer may be this value, with no pair named, when
/// every pair is farther. Pass about twice the required separation.
/// @param excused  one a drone, or empty: pairs with a drone that is not 0 here are left out. certify() passes those
/// that stand on their pads during a take-off or landing, see there. Properties: (1) lower bound never above a dense
/// sampling's minimum (2) within 2 % of it below beyond_m (3) permuting drones changes only names (4) scaling time
/// changes nothing (5) nor does the number of threads. Errors: stopped. Accuracy and cost: the bound is within 2e-6 of
/// the distance named (exact for holds and straight acts) and 1e-9 m; about n log n. 10,000 drones: milliseconds for a
/// straight act, tens of them for a lattice of 60 intervals.
Result<SeparationBound> bound_separation(const Motion& motion, double duration_s, const SeparationMetric& metric,
                                         double beyond_m, const Run& run, std::span<const std::uint8_t> excused = {});

/// What one act was found to do, worst over all drones and instants, and whether that is within the limits.
struct ActCertificate {
    std::string name;
    ActRole role = ActRole::hold;
    Millis start_ms = 0, duration_ms = 0;
    double required_separation_m = 0.0;  ///< planned_separation_m(limits), or more where it was asked for
    SeparationBound separation;
    Extremes extremes;
    std::optional<PlaneExtremes> plane;                 ///< of planes alone
    double altitude_min_m = 0.0, altitude_max_m = 0.0;  ///< above own pads
    std::optional<double> geofence_margin_m;            ///< smallest distance to the fence from inside
    std::optional<double> audience_margin_m;            ///< smallest distance to an audience polygon from outside
    std::optional<double> obstacle_margin_m;            ///< smallest clearance
    std::vector<std::string> violations;                ///< each names limit, value, drones, time; empty: certified
    // How the act came about; filled by the planner, shown in reports.
    std::string method;          ///< "straight", "spectral", "flow", "hold"
    std::string chosen_because;  ///< why `auto` chose this method; "" otherwise
    std::string separation_by;   ///< "" (none needed), "projection", and the rungs taken
    int separation_rounds = 0;   ///< projection iterations
    std::string assignment;      ///< "shortest, gap 0, pairwise", ...
    double path_ratio = 1.0;     ///< flown length over straight-line length

    [[nodiscard]] bool certified() const { return violations.empty(); }
};

struct Certificate {
    std::vector<ActCertificate> acts;
    std::vector<std::string> violations;  ///< of the whole show (endurance)
    [[nodiscard]] bool certified() const;
    [[nodiscard]] double min_separation_m() const;  ///< smallest lower bound over the acts
};

/// What an act is judged against beside its limits.
struct Surroundings {
    geo::ShowFrame frame;
    geo::Airspace airspace;
    Points pads_m;  ///< one a drone: altitudes are above own pad
    Limits limits;
};

/// Judges one act against limits and airspace in continuous time. A horizontal motion below the minimum navigation
/// altitude is a violation whatever the act's role.
/// Separation: a pair is excused in an act of role takeoff or landing in which every drone stays over its own pad, and
/// only if at least one of the two stands on its pad (both to 1e-6 m) from the act's first instant to its last. Nobody
/// else is ever excused: two drones that both leave the ground during the act are judged, and so is every pair in an
/// act of another role. So a fleet whose pads are closer than the separation can leave in layers and waves, and no
/// other way. Accuracy: altitudes to 1e-4 m; margins to a millimetre near zero and a thousandth elsewhere. Errors:
/// stopped.
/// @param asked_separation_m  what this act must keep where that is more than planned_separation_m(limits).
Result<ActCertificate> certify(const Act& act, const Surroundings& surroundings, const Run& run,
                               double asked_separation_m = 0.0);

}  // namespace aerogram::planner
