#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "geo/limits.hpp"
#include "geo/tracks.hpp"
#include "planner/motion/act.hpp"

/// What planes must hold: they cannot stop, turn on the spot or climb at will (Limits::plane).
namespace aerogram::planner {

/// The largest or smallest value of a quantity at any instant, of whom, and when about.
struct PlaneWorst {
    double value = 0.0;  ///< bounded in continuous time, on the strict side
    std::size_t drone = 0;
    double time_s = 0.0;  ///< act-local
};

/// An act in the ground frame as planes fly it. Airspeed is |v|, no wind; the turn rate is that of the heading seen
/// from above, infinite where a drone stands or moves upright.
struct PlaneExtremes {
    PlaneWorst airspeed_min_mps, airspeed_max_mps, turn_rate_dps, climb_mps, sink_mps;
};

/// Bounds the five quantities over all drones: on every knot interval the velocity is a quadratic Bézier whose hull
/// bounds it, and the turn rate's numerator v × a a cubic one; intervals are halved until the bound is within 1e-5 of a
/// value that is attained.
/// Properties: (1) never on the lenient side of a dense sampling (2) within 1e-4 of it (3) a steady circle gives its
/// closed form.
[[nodiscard]] PlaneExtremes plane_extremes(const Motion& motion, double duration_s);

/// Each limit that is not held: limit, value, drone and show time. Empty: all are.
[[nodiscard]] std::vector<std::string> plane_violations(const PlaneExtremes& found, const PlaneLimits& limits,
                                                        Millis start_ms);

}  // namespace aerogram::planner
