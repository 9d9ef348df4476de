#pragma once
#include <vector>

#include "export/report/report.hpp"
#include "export/report/survey.hpp"

/// The parts of make_report; each fills in its own fields.
namespace aerogram::exporter {

/// Report::rules: the judgement's, then reserve and lights of the report itself, which must be there already.
void report_rules(const ReportInput& input, Report& report);
/// Report::warnings, from all that was computed before.
void report_warnings(Report& report);

/// nearest_m and histogram.
void report_nearest(const Survey& all, const Run& run, Report& report);
/// encounters: from straight lines between the report's times, refined on the exact flights.
void report_encounters(const OutgoingShow& show, const Survey& all, const Run& run, Report& report);
/// alignments, their radius and height.
void report_alignments(const OutgoingShow& show, const Survey& all, const Run& run, Report& report);

/// turns, energy, tracks_m, homes_m.
void report_flights(const OutgoingShow& show, const Survey& all, Report& report);

/// emergencies, their model and resolution.
void report_emergencies(const OutgoingShow& show, const Survey& all, const Run& run, Report& report);

/// sensitivities.
void report_sensitivity(const OutgoingShow& show, const Run& run, Report& report);

/// What flashes: WCAG 2.3.1, general flashes. Luminance 0.2126 R + 0.7152 G + 0.0722 B of linear light, 1 = all white.
[[nodiscard]] ReportLights report_lights(const OutgoingShow& show, const Run& run);

/// Largest number of pairs of opposing changes of at least 0.1, the darker state below 0.8, in any second.
/// @param values  luminance from change to change: between two of them it is linear; times rise, seconds.
struct Luminance {
    double time_s = 0.0, value = 0.0;
};
struct Flashes {
    double most_hz = 0.0;  ///< half the number of changes in the second that has most
    double time_s = 0.0;   ///< where that second begins
};
[[nodiscard]] Flashes flashes(const std::vector<Luminance>& values);

}  // namespace aerogram::exporter
