#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "export/record/recorded_show.hpp"
#include "export/verify/rules.hpp"
#include "geo/run.hpp"

namespace aerogram::exporter {

/// What is claimed of every drone at every instant of a stretch of a show: nothing is above the largest values, below
/// the lowest altitude (above own home), or nearer to a boundary than the margin.
struct Claims {
    double begin_s = 0.0, end_s = 0.0;
    double speed_horizontal_mps = 0.0, speed_up_mps = 0.0, speed_down_mps = 0.0;
    double acceleration_mps2 = 0.0, jerk_mps3 = 0.0;
    double altitude_min_m = 0.0, altitude_max_m = 0.0;
    std::optional<double> geofence_margin_m, audience_margin_m, obstacle_margin_m;
    struct Plane {
        double airspeed_min_mps = 0.0, airspeed_max_mps = 0.0, turn_rate_dps = 0.0;
    };
    std::optional<Plane> plane;  ///< of planes: nobody is slower, faster, or turns faster
};

/// What a drone really has at an instant, and no claim allows.
struct BrokenClaim {
    std::string what;  ///< as certificate.json names it, "max_speed_up_mps"
    double claimed = 0.0, found = 0.0;
    std::size_t drone = 0;  ///< 0-based
    double time_s = 0.0;
};

/// The worst instance of each claim that does not hold by more than the show's rounding and the verifier's arithmetic
/// (altitudes: 1 mm more; obstacles: 0.1 mm more); empty: all hold. Pieces belong to the stretch in which their middle
/// lies. Negative margins claim nothing.
/// @param show  well-formed and timed.
/// @param rules  airspace, frame and rounding; limits are not looked at.
[[nodiscard]] std::vector<BrokenClaim> broken_claims(const RecordedShow& show, const Rules& rules, const Claims& claims,
                                                     const Run& run);

}  // namespace aerogram::exporter
