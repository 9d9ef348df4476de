#pragma once
#include <optional>
#include <string>
#include <vector>

#include "export/record/recorded_show.hpp"
#include "geo/result.hpp"
#include "geo/run.hpp"

/// The second opinion: from files to numbers with code of its own. It shares with the planner the vector types, the frame
/// conversion and the readers' byte parsing, and no separation, limit, fence or spline code.
namespace aerogram::exporter {

/// One rule, its limit, and the worst that was found.
struct Finding {
    std::string rule;                    ///< "separation", "speed_up", "acceleration", "altitude_max", "geofence", ...
    double limit = 0.0, worst = 0.0;     ///< SI
    double allowance = 0.0;              ///< what the format's rounding may add (stated per format)
    std::vector<std::size_t> drones;     ///< numbers from 1
    std::optional<double> time_s;
    bool held = true;
};

/// What a show was found to do.
struct Judgement {
    std::string format;
    std::string limits_from;             ///< where the limits came from: "manifest.json", "the file", "preset standard"
    bool separation_claimed = true;      ///< false for untimed waypoints
    double min_separation_m = 0.0;       ///< certified lower bound, continuous time, on what the file says
    std::vector<Finding> findings;       ///< one a rule that applies
    std::vector<std::string> problems;   ///< what is wrong beyond numbers: hashes, missing drones, unreadable files
    [[nodiscard]] bool held() const;
};

/// Judges a show against limits, exactly, under the file's own interpolation rule.
/// @param limits, airspace, origin  used where the show itself has none.
struct JudgeAgainst {
    std::optional<Limits> limits;
    std::optional<geo::Airspace> airspace;
    std::optional<geo::ShowOrigin> origin;
    std::optional<double> endurance_s;
    std::string limits_from = "preset standard";
};
Result<Judgement> judge(const RecordedShow& show, const JudgeAgainst& against, const Run& run);

/// Smallest distance of any two drones at any instant while not both on the ground, on piecewise Bézier curves of any degree
/// and knots. lower_bound <= truth <= attained.
struct VerifiedSeparation {
    double lower_bound_m = 0.0, attained_m = 0.0;
    std::size_t first = 0, second = 0;   ///< 0-based
    double time_s = 0.0;
};
Result<VerifiedSeparation> verify_separation(const RecordedShow& show, double downwash, double beyond_m, const Run& run);

}  // namespace aerogram::exporter
