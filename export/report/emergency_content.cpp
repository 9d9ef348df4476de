#include <algorithm>
#include <array>
#include <limits>

#include "export/report/report_content.hpp"
#include "export/report/report_words.hpp"

namespace aerogram::exporter {
namespace {

struct Manoeuvre {
    const char* name;
    const char* column;
    ReportApproach ReportEmergency::*approach;
};
constexpr std::array<Manoeuvre, 6> kManoeuvres{{{"One drone holds in place", "1 holds", &ReportEmergency::one_holds},
                                                {"One drone lands now", "1 lands", &ReportEmergency::one_lands},
                                                {"One drone returns", "1 returns", &ReportEmergency::one_returns},
                                                {"All hold in place", "all hold", &ReportEmergency::all_hold},
                                                {"All land now", "all land", &ReportEmergency::all_land},
                                                {"All return", "all return", &ReportEmergency::all_return}}};

bool too_close(const ReportApproach& a, const Report& report) {
    return a.distance_m && *a.distance_m < report.limits.min_separation_m;
}

TableRow worst_row(const Report& report, const Manoeuvre& m) {
    const ReportEmergency* worst = nullptr;
    std::size_t close = 0;
    for (const ReportEmergency& e : report.emergencies) {
        const ReportApproach& a = e.*m.approach;
        if (too_close(a, report)) ++close;
        if (a.distance_m && (worst == nullptr || *a.distance_m < *(worst->*m.approach).distance_m)) worst = &e;
    }
    if (worst == nullptr) return {{m.name, kAbsent, kAbsent, kAbsent, kAbsent, kAbsent}};
    const ReportApproach& a = worst->*m.approach;
    return {{m.name, fixed_text(*a.distance_m, 2), std::to_string(a.first) + " and " + std::to_string(a.second),
             clock_text(worst->time_s, 0), clock_text(a.time_s), count_text(close)},
            too_close(a, report)};
}

Chart approaches(const Report& report, const char* name, const char* title, std::size_t begin) {
    Chart chart;
    chart.name = name;
    chart.title = title;
    chart.unit = "m";
    chart.x_unit = "min:s";
    for (const ReportEmergency& e : report.emergencies) chart.x.push_back(e.time_s);
    for (std::size_t i = begin; i < begin + 3; ++i) {
        ChartLine line{kManoeuvres[i].column, {}};
        for (const ReportEmergency& e : report.emergencies)
            line.values.push_back(
                (e.*kManoeuvres[i].approach).distance_m.value_or(std::numeric_limits<double>::quiet_NaN()));
        chart.lines.push_back(std::move(line));
    }
    chart.limits = {{"smallest separation of the show", report.limits.min_separation_m}};
    chart.bands = keyframe_bands(report);
    return chart;
}

Table every_second(const Report& report) {
    Table table{
        "emergency", "Every second: closest approach in metres if it happens at this time", {{"Time", 8, true}}, {}};
    table.side_by_side = 2;
    for (const Manoeuvre& m : kManoeuvres) table.columns.push_back({m.column, 9.5, true});
    for (const ReportEmergency& e : report.emergencies) {
        TableRow row{{clock_text(e.time_s, 0)}, false, {}};
        for (const Manoeuvre& m : kManoeuvres) {
            const ReportApproach& a = e.*m.approach;
            if (too_close(a, report)) row.bad_cells.push_back(row.cells.size());
            row.cells.push_back(a.distance_m ? fixed_text(*a.distance_m, 2) : kAbsent);
        }
        table.rows.push_back(std::move(row));
    }
    return table;
}

}  // namespace

Section emergency_section(const Report& report) {
    Section section{
        "emergency",
        "Emergencies",
        "What happens if at a given second one drone, the worst one to choose, or all of them leave the show: "
        "the closest that any two come, in the measure of separation. Bold with *: below the show's "
        "smallest separation of " +
            fixed_text(report.limits.min_separation_m, 2) + " m.",
        {}};
    if (!report.emergency_model.empty()) section.blocks.emplace_back(Words{report.emergency_model, Tone::plain});
    if (report.emergency_resolution_m > 0.0) {
        section.blocks.emplace_back(Words{
            "Distances of one drone from the rest are exact to " + fixed_text(report.emergency_resolution_m, 3) + " m.",
            Tone::note});
    }
    Table worst{"emergency-worst",
                "Worst over the show",
                {{"Manoeuvre", 26},
                 {"Closest (m)", 11, true},
                 {"Drones", 16, true},
                 {"Ordered at", 11, true},
                 {"Closest at", 11, true},
                 {"Seconds below the separation", 21, true}},
                {}};
    for (const Manoeuvre& m : kManoeuvres) worst.rows.push_back(worst_row(report, m));
    section.blocks.emplace_back(std::move(worst));
    if (report.emergencies.size() > 1) {
        section.blocks.emplace_back(approaches(report, "emergency-one", "One drone leaves the show", 0));
        section.blocks.emplace_back(approaches(report, "emergency-all", "All drones leave the show", 3));
    }
    section.blocks.emplace_back(every_second(report));
    return section;
}

}  // namespace aerogram::exporter
