#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "export/outgoing/polyline.hpp"
#include "export/outgoing/program.hpp"
#include "export/report/parts.hpp"
#include "export/report/report.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

constexpr std::size_t kMostInstants = 1500, kMostTracks = 200;
constexpr double kTrack_m = 0.25;  ///< tracks are thinned to this

/// The shortest round step with few enough instants.
double step_for(double duration_s) {
    for (const double step_s : {0.1, 0.2, 0.25, 0.5}) {
        if (duration_s / step_s <= static_cast<double>(kMostInstants - 1)) return step_s;
    }
    return std::max(1.0, std::ceil(duration_s / static_cast<double>(kMostInstants - 1)));
}

std::vector<double> instants(double duration_s, double step_s) {
    std::vector<double> times_s;
    for (std::size_t k = 0; static_cast<double>(k) * step_s < duration_s - 1e-9; ++k)
        times_s.push_back(static_cast<double>(k) * step_s);
    times_s.push_back(duration_s);
    return times_s;
}

std::string profile(const OutgoingFacts& facts) {
    const Limits& l = facts.limits;
    std::array<char, 300> text{};
    if (l.plane) {
        std::snprintf(text.data(), text.size(),
                      ", planes, %.2f m separation, %.3g to %.3g m/s, %.3g up, %.3g down, %.3g m/s²",
                      l.min_separation_m, l.plane->airspeed_min_mps, l.plane->airspeed_max_mps, l.plane->climb_mps,
                      l.plane->sink_mps, l.acceleration_mps2);
    } else {
        std::snprintf(
            text.data(), text.size(), ", copters, %.2f m separation, %.3g m/s across, %.3g up, %.3g down, %.3g m/s²",
            l.min_separation_m, l.speed_horizontal_mps, l.speed_up_mps, l.speed_down_mps, l.acceleration_mps2);
    }
    return std::to_string(facts.drones.size()) + (facts.drones.size() == 1 ? " drone" : " drones") + text.data();
}

void page_one(const ReportInput& input, Report& report) {
    const OutgoingFacts& facts = input.show.facts();
    report.title = facts.title;
    report.show_hash = input.show_hash;
    report.program = kProgramName;
    report.version = kProgramVersion;
    report.certified = input.certified;
    report.reasons = input.reasons;
    report.profile = profile(facts);
    report.drones = facts.drones.size();
    report.duration_s = seconds_from_ms(facts.duration_ms);
    report.wind_mps = facts.reporting.wind_mps;
    report.endurance_s = facts.endurance_s;
    report.origin = facts.origin;
    report.limits = facts.limits;
    report.min_separation_m = input.judgement.min_separation_m;
    report.airspace = facts.airspace;
    report.keyframes = facts.keyframes;
    for (OutgoingKeyframe& k : report.keyframes) k.places_m.clear();
    report.formats = input.formats;
}

}  // namespace

void report_flights(const OutgoingShow& show, const Survey& all, Report& report) {
    const OutgoingFacts& facts = show.facts();
    double sum = 0.0;
    for (std::size_t d = 0; d < show.drones(); ++d) {
        report.homes_m.push_back(facts.drones[d].home_m);
        report.turns.push_back(all.drones[d].turn);
        const double used = all.drones[d].energy_s / facts.endurance_s;
        sum += used;
        if (d == 0 || used > report.energy.most_used) {
            report.energy.most_used = used;
            report.energy.most_used_by = facts.drones[d].number;
        }
    }
    report.energy.mean_used = sum / static_cast<double>(show.drones());
    report.energy.least_reserve = 1.0 - report.energy.most_used;
    report.energy.wanted_reserve = facts.reporting.reserve_percent / 100.0;
    report.energy.held = report.energy.least_reserve >= report.energy.wanted_reserve;
    report.energy.model = energy_model(facts.limits.plane.has_value());
    const std::size_t shown = std::min(show.drones(), kMostTracks);
    for (std::size_t t = 0; t < shown; ++t) {
        const std::size_t d = t * show.drones() / shown;
        std::vector<Corner> corners;
        for (std::size_t k = 0; k < all.instants; ++k) {
            const double t_ms = std::min(static_cast<double>(k) * all.step_s(), all.duration_s) * 1000.0;
            corners.push_back({static_cast<Millis>(std::llround(t_ms)), all.from_metric(wide(all.place(d, k)))});
        }
        report.tracks_m.emplace_back();
        for (const Corner& c : thinned(corners, kTrack_m)) report.tracks_m.back().push_back(c.place_m);
    }
}

Result<Report> make_report(const ReportInput& input, const Run& run) {
    Report report;
    page_one(input, report);
    report.step_s = step_for(report.duration_s);
    report.times_s = instants(report.duration_s, report.step_s);
    report.lights = report_lights(input.show, run);
    report_sensitivity(input.show, run, report);
    report.volumes = flight_volumes(input.show, run);
    if (run.stopped()) return stopped_error();
    const Survey all = survey(input.show, report.times_s, run);
    if (run.stopped()) return stopped_error();
    report.series = all.series;
    report_flights(input.show, all, report);
    report_nearest(all, run, report);
    report_encounters(input.show, all, run, report);
    report_alignments(input.show, all, run, report);
    if (run.stopped()) return stopped_error();
    report_emergencies(input.show, all, run, report);
    report_rules(input, report);
    report_warnings(report);
    if (run.stopped()) return stopped_error();
    return report;
}

}  // namespace aerogram::exporter
