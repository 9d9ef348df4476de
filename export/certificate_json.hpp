#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "geo/result.hpp"
#include "planner/motion/flight_plan.hpp"

/// certificate.json: what the planner certified, act by act (docs/formats/certificate.md).
namespace aerogram::exporter {

inline constexpr std::string_view kCertificateName = "certificate.json";

/// One act as the file tells it. Times in show time.
struct CertifiedAct {
    std::string name, role;
    double start_s = 0.0, duration_s = 0.0;
    double required_separation_m = 0.0;
    std::optional<double> min_separation_m;                   ///< lower bound; absent with fewer than two drones
    std::optional<double> closest_m;                          ///< attained by `pair` at `time_s`
    std::optional<std::pair<std::size_t, std::size_t>> pair;  ///< drone numbers from 1
    std::optional<double> time_s;
    double speed_horizontal_mps = 0.0, speed_up_mps = 0.0, speed_down_mps = 0.0;
    double acceleration_mps2 = 0.0, jerk_mps3 = 0.0;
    double altitude_min_m = 0.0, altitude_max_m = 0.0;
    std::optional<double> geofence_margin_m, audience_margin_m, obstacle_margin_m;
    struct Plane {
        double airspeed_min_mps = 0.0, airspeed_max_mps = 0.0, turn_rate_dps = 0.0;
    };
    std::optional<Plane> plane;  ///< of planes alone
    std::string method, separation_by, assignment;
    std::string chosen_because;  ///< why `auto` chose the method; empty: it was named
    int separation_rounds = 0;
    double path_ratio = 1.0;
    bool certified = false;
    std::vector<std::string> violations;
};

struct CertificateRecord {
    std::string show_name, show_hash;
    bool certified = false;
    std::optional<double> min_separation_m;
    std::vector<std::string> violations;  ///< of the whole show
    std::vector<CertifiedAct> acts;
};

/// The file's text.
std::string certificate_json(const planner::FlightPlan& plan, std::string_view show_hash, bool certified);

/// Errors: invalid_input naming the field.
Result<CertificateRecord> read_certificate(std::string_view bytes);

}  // namespace aerogram::exporter
