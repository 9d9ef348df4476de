#pragma once
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "export/record/recorded_show.hpp"
#include "geo/result.hpp"
#include "geo/run.hpp"

/// The second opinion: from files to numbers with code of its own. It shares with the planner the vector types, the
/// frame conversion and the readers' byte parsing, and no separation, limit, fence or spline code.
namespace aerogram::exporter {

/// One rule, its limit, and the worst that was found.
struct Finding {
    std::string rule;                 ///< "separation", "speed_up", "acceleration", "altitude_max", "geofence", ...
    double limit = 0.0, worst = 0.0;  ///< SI
    double allowance = 0.0;  ///< what the format's rounding may add (stated per format); of altitudes 1 mm more
    std::vector<std::size_t> drones;  ///< numbers from 1
    std::optional<double> time_s;
    bool held = true;
};

/// What a show was found to do.
struct Judgement {
    std::string format;
    std::string limits_from;         ///< where the limits came from: "manifest.json", "the file", "preset standard"
    std::string timing;              ///< RecordedShow::timing
    bool separation_claimed = true;  ///< false for untimed waypoints
    double min_separation_m = 0.0;  ///< certified lower bound, continuous time, on what the file says; where all drones
                                    ///< stay farther apart than twice the limit, just that
    double closest_m = 0.0;         ///< a distance two drones really have (infinite when all stay farther apart)
    std::vector<Finding> findings;  ///< one a rule that applies
    std::vector<std::string> problems;  ///< what is wrong beyond numbers: hashes, missing drones, unreadable files
    [[nodiscard]] bool held() const;
};

/// Two drones and an instant at which they are likely close: where another file of the show has its smallest distance.
struct LikelyClosest {
    std::size_t first = 0, second = 0;  ///< 0-based
    double time_s = 0.0;
};

/// Where a judged show has its smallest separation; absent when no two drones are near.
[[nodiscard]] std::optional<LikelyClosest> closest_of(const Judgement& judgement);

/// What a show is judged against where it says nothing itself.
struct JudgeAgainst {
    std::optional<Limits> limits;  ///< neither here nor in the show: the standard preset
    std::optional<geo::Airspace> airspace;
    std::optional<geo::ShowOrigin> origin;
    std::optional<double> endurance_s;
    std::string limits_from = "preset standard";  ///< where `limits` came from, for people
    std::optional<double> claimed_separation_m;   ///< separation is resolved at least up to here
    std::optional<LikelyClosest>
        likely_closest{};  ///< makes the search faster when it is right, never changes its bound
};
/// Judges a show exactly, in continuous time, under the file's own interpolation rule. A rule holds when its worst
/// value is within limit and allowance; allowances are the show's stated rounding, and separation has none; altitudes
/// are judged to 1 mm more. A drone is on the ground, and its altitude counts, at the home and landing place that the
/// show states; without them z = 0 is the ground. Waypoints without times are judged by their places only. The rules:
///  - separation, m, at least;
///  - speed_horizontal, speed_up, speed_down, m/s; acceleration, m/s²;
///  - of planes, in the place of the three speeds: airspeed_min, airspeed_max, climb, sink, m/s; turn_rate_dps;
///  - velocity_jump, m/s: where pieces meet, and at the ends, where a copter must be at rest; position_jump, m;
///  - altitude_max, m above own home; altitude_min, m above own home (or the landing place where that is lower), at
///    least 0, to 0.05 m; altitude_min_navigation, horizontal metres flown in one stay below that altitude;
///  - geofence, audience, obstacles: margin, m, at least;
///  - of missions whose drones wait for times, while they stand so: separation_standing, m; leaving_times, s;
///  - pads, m, of copters: from home at the start, from the landing place at the end; endurance, s.
///
/// Properties: (1) each worst value is the true one to 1e-6 (separation 1e-5, obstacles 1e-4; 1 % of what is beyond a
/// fence), never on the lenient side (2) threads change nothing. Errors: invalid_input for shows that are not well
/// formed; stopped.
Result<Judgement> judge(const RecordedShow& show, const JudgeAgainst& against, const Run& run);

/// Which part of the show counts, and how far lower bound and attained distance may be apart.
struct SeparationSearch {
    double begin_s = -std::numeric_limits<double>::infinity(), end_s = std::numeric_limits<double>::infinity();
    double resolved_m = 1e-5;
    std::optional<LikelyClosest> likely_closest{};  ///< looked at first: who is farther apart is soon passed over
};
/// lower_bound_m <= truth <= attained_m, the latter by this pair at this time.
struct VerifiedSeparation {
    double lower_bound_m = 0.0, attained_m = 0.0;
    std::size_t first = 0, second = 0;  ///< 0-based
    double time_s = 0.0;
};
/// Smallest distance of any two drones at any instant unless excused() (export/verify/ground.hpp), on
/// piecewise Bézier curves of any degree and knots. Distances within resolved_m of 0 are a lower bound of 0. When all
/// stay at least beyond_m apart, that is the lower bound, and attained is infinite.
///
/// @param downwash  >= 1.
/// @param beyond_m  > 0; distances from here on are not resolved.
///
/// Properties: (1) the lower bound is never above a dense sampling's minimum (2) permuting drones changes only names
/// (3) threads change nothing.
///
/// Errors: invalid_input for shows that are not well formed; stopped.
///
/// Accuracy and cost: arithmetic 1e-9 m within 100 km of the origin, taken off the lower bound; about 0.05 ms a drone
/// and minute.
Result<VerifiedSeparation> verify_separation(const RecordedShow& show, double downwash, double beyond_m, const Run& run,
                                             const SeparationSearch& search = {});

}  // namespace aerogram::exporter
