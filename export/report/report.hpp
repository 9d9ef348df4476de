#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "export/outgoing/outgoing_show.hpp"
#include "export/outgoing/volumes.hpp"
#include "export/verify/judge.hpp"
#include "geo/result.hpp"
#include "geo/run.hpp"

/// The flight validation report: what a pilot reads and signs. `make_report` (numbers) is the only place that computes;
/// report_json, report_html and report_pdf (report_files.hpp) show the same struct. SI units, show frame, show time.
namespace aerogram::exporter {

/// A limit, the worst that was found, and where.
struct ReportRule {
    std::string rule;       ///< Finding::rule, "separation"
    std::string title;      ///< for people, "Separation of any two drones"
    std::string unit;       ///< "m", "m/s", ...
    bool at_least = false;  ///< the limit is a lower one
    double limit = 0.0, worst = 0.0, allowance = 0.0;
    double margin = 0.0;              ///< how far the worst is on the good side; negative: broken
    std::vector<std::size_t> drones;  ///< numbers
    std::optional<double> time_s;
    std::optional<Vec3> place_m;  ///< of the first of the drones then
    bool held = true;
};

/// Worst of the fleet at each of Report::times_s.
struct ReportSeries {
    std::string name, unit;  ///< "Highest altitude", "m"
    std::vector<double> values;
    std::optional<double> limit;
    std::optional<double> lower_limit;
};

/// Two drones near each other: the closest of one approach.
struct ReportEncounter {
    std::size_t first = 0, second = 0;  ///< numbers; of an alignment: the upper and the lower
    double time_s = 0.0;
    double distance_m = 0.0;  ///< in the separation metric
    double horizontal_m = 0.0, vertical_m = 0.0;
    Vec3 place_m{};  ///< half way
};

struct ReportTurn {
    std::size_t drone = 0;                 ///< number
    double leaves_s = 0.0, lands_s = 0.0;  ///< first and last instant off the ground
    Vec3 home_m{}, land_m{};
};

/// Shares of the endurance: hovering costs 1 a second; model and source in docs/report.md.
struct ReportEnergy {
    double mean_used = 0.0, most_used = 0.0;  ///< share of the endurance, 0..1 (more: it would not come home)
    std::size_t most_used_by = 0;             ///< number
    double least_reserve = 0.0;               ///< 1 - most_used
    std::string model;                        ///< in words
    double wanted_reserve = 0.15;
    bool held = true;
};

/// The closest approach of an emergency manoeuvre; distance absent where there is nobody else.
struct ReportApproach {
    std::optional<double> distance_m;   ///< separation metric
    std::size_t first = 0, second = 0;  ///< numbers; the first is the one that left the show
    double time_s = 0.0;                ///< show time of the closest approach
};
/// What happens if at time_s one drone (the worst one to choose) or all of them leave the show.
struct ReportEmergency {
    double time_s = 0.0;
    ReportApproach one_holds, one_lands, one_returns;
    ReportApproach all_hold, all_land, all_return;
};

/// The show turned or moved as a whole by mistake.
struct ReportSensitivity {
    std::string change;  ///< "heading +3°", "origin 3 m east"
    std::optional<double> geofence_margin_m, audience_margin_m, obstacle_margin_m;
    double farthest_moved_m = 0.0;  ///< how far the mistake moves the drone that it moves most
    bool held = true;
};

struct ReportLights {
    std::size_t keys = 0;           ///< of all drones together
    double most_keys_per_s = 0.0;   ///< of one drone in any second
    double fastest_flash_hz = 0.0;  ///< of a pair of opposing changes of luminance of one lamp
    double fleet_flash_hz = 0.0;    ///< of the fleet's mean luminance
    double fleet_flash_s = 0.0;     ///< when
    bool warning = false;           ///< WCAG 2.3.1: more than three flashes in a second of what fills the view
};

struct ReportFormat {
    std::string name, timing, skipped;
    std::size_t files = 0;
    std::optional<double> min_separation_m;  ///< found in the written files, after their rounding
    double position_error_m = 0.0;           ///< stated: fit and rounding
    std::vector<std::string> problems;
    bool held = true;
};

struct Report {
    // Page 1.
    std::string title, show_hash, program, version;
    bool certified = false;               ///< false: every page says so
    std::vector<std::string> reasons;     ///< why not; empty when certified
    std::vector<std::string> warnings{};  ///< what the pilot must weigh: reserve, flashes, volumes over people
    std::string profile;                  ///< "10 drones, copters, 1.5 m separation, ..."
    std::size_t drones = 0;
    double duration_s = 0.0, wind_mps = 0.0, endurance_s = 0.0;
    std::optional<geo::ShowOrigin> origin;
    Limits limits;
    double min_separation_m = 0.0;  ///< certified lower bound
    std::vector<ReportRule> rules;
    // Over time.
    double step_s = 0.0;  ///< times_s are its multiples below the duration, and the duration
    std::vector<double> times_s;
    std::vector<ReportSeries> series;  ///< altitudes, speeds, acceleration, jerk; largest (lowest) up to the next time
    std::vector<double> nearest_m;  ///< the closest pair, at each of times_s, in the separation metric; infinite: none
    double histogram_step_m = 0.25;
    std::vector<std::size_t> histogram;       ///< drone-instants in flight by distance to the nearest; last: all beyond
    std::vector<OutgoingKeyframe> keyframes;  ///< without places
    std::vector<ReportEncounter> encounters;  ///< at most 20, closest first, one an approach
    std::vector<ReportEncounter> alignments;  ///< at most 20: one drone in the downwash of another
    double alignment_radius_m = 0.0, alignment_height_m = 0.0;  ///< what counts as in the downwash
    // Places.
    geo::Airspace airspace;
    FlightVolumes volumes;
    std::vector<Points> tracks_m;  ///< thinned ways of at most 200 drones, for plan and elevation
    Points homes_m;
    // Who, when, how much.
    std::vector<ReportTurn> turns;  ///< by drone
    ReportEnergy energy;
    // What if.
    std::string emergency_model;               ///< braking, speeds, altitudes, in words
    double emergency_resolution_m = 0.0;       ///< distances of one drone against the flying rest are this exact
    std::vector<ReportEmergency> emergencies;  ///< one a second
    std::vector<ReportSensitivity> sensitivities;
    ReportLights lights;
    std::vector<ReportFormat> formats;
};

struct ReportInput {
    const OutgoingShow& show;
    const Judgement& judgement;  ///< of trajectories.bin, or of the file that was read
    std::string show_hash;
    bool certified = false;
    std::vector<std::string> reasons;
    std::vector<ReportFormat> formats;
};

/// Computes everything. Properties: (1) threads change nothing (2) the rules are the judgement's. Cost: about a minute
/// on two cores for 10,000 drones and ten minutes; memory beside the show below 1.5 GiB. Errors: stopped.
Result<Report> make_report(const ReportInput& input, const Run& run);

}  // namespace aerogram::exporter
