#include <array>
#include <cmath>

#include "export/report/report_content.hpp"
#include "export/report/report_words.hpp"

namespace aerogram::exporter {
namespace {

TableRow rule_row(const ReportRule& rule) {
    const int digits = rule_digits(rule);
    return {{rule.title, (rule.at_least ? "≥ " : "≤ ") + fixed_text(rule.limit, digits),
             rule.allowance >= 0.0005 ? fixed_text(rule.allowance, 3) : kAbsent, fixed_text(rule.worst, digits),
             signed_text(rule.margin, digits), rule.unit, drones_text(rule.drones, 2),
             rule.time_s ? clock_text(*rule.time_s) : kAbsent, rule.place_m ? place_text(*rule.place_m) : kAbsent,
             rule.held ? "held" : "BROKEN"},
            !rule.held};
}

/// A title for several lines of one unit.
std::string together(const std::string& unit) {
    return unit == "m" ? "Altitudes" : unit == "m/s" ? "Speeds" : unit == "m/s²" ? "Accelerations" : "In " + unit;
}

}  // namespace

Section rules_section(const Report& report) {
    Section section{"rules",
                    "Rules",
                    "Each limit, the worst that any drone does at any instant, and how far that is on the good side.",
                    {}};
    for (const std::string& reason : report.certified ? std::vector<std::string>{} : report.reasons)
        section.blocks.emplace_back(Words{reason, Tone::bad});
    Table table{"rules",
                "",
                {{"Rule", 26},
                 {"Limit", 10, true},
                 {"Allowance", 9, true},
                 {"Worst", 10, true},
                 {"Margin", 10, true},
                 {"Unit", 6},
                 {"Drones", 13},
                 {"Time", 8, true},
                 {"Place x, y, z (m)", 17, true},
                 {"", 8}},
                {}};
    for (const ReportRule& rule : report.rules) table.rows.push_back(rule_row(rule));
    section.blocks.emplace_back(std::move(table));
    return section;
}

Section over_time_section(const Report& report) {
    Section section{"time",
                    "Altitude, speed, acceleration and jerk over time",
                    "At each instant the worst of the whole fleet. Dashed: the limit. Grey: formations that stand.",
                    {}};
    constexpr std::size_t kTogether = 3;  // lines a chart
    for (const ReportSeries& series : report.series) {
        Chart* last = section.blocks.empty() ? nullptr : &std::get<Chart>(section.blocks.back());
        if (last == nullptr || last->unit != series.unit || last->lines.size() == kTogether) {
            section.blocks.emplace_back(Chart{});
            last = &std::get<Chart>(section.blocks.back());
            last->name = "time-" + std::to_string(section.blocks.size());
            last->unit = series.unit;
            last->x_unit = "min:s";
            last->x = report.times_s;
            last->bands = keyframe_bands(report);
        }
        const std::size_t line = last->lines.size();
        last->title = line == 0 ? series.name : together(series.unit);
        last->lines.push_back({series.name, series.values});
        if (series.limit) last->limits.push_back({"limit", *series.limit, line});
        if (series.lower_limit) last->limits.push_back({"lower limit", *series.lower_limit, line});
    }
    return section;
}

Section energy_section(const Report& report) {
    const ReportEnergy& e = report.energy;
    Section section{"energy",
                    "Energy",
                    "An estimate from the way each drone flies, in shares of the endurance. It replaces no test flight "
                    "with the batteries in use.",
                    {}};
    if (!e.model.empty()) section.blocks.emplace_back(Words{e.model, Tone::plain});
    section.blocks.emplace_back(
        Facts{{{"Endurance, hovering", clock_text(report.endurance_s) + " min:s"},
               {"Used, mean of the fleet", percent_text(e.mean_used, 1) + " of the endurance"},
               {"Used, most", percent_text(e.most_used, 1) + ", drone " + std::to_string(e.most_used_by)},
               {"Reserve, least", percent_text(e.least_reserve, 1)},
               {"Reserve, wanted", percent_text(e.wanted_reserve, 1)}}});
    section.blocks.emplace_back(
        e.held ? Words{"The reserve is kept by every drone.", Tone::good}
               : Words{"The reserve is not kept: fly with larger batteries or plan a shorter show.", Tone::bad});
    return section;
}

Section sensitivity_section(const Report& report) {
    Section section{
        "sensitivity",
        "If heading or origin were wrong",
        "The whole show turned or moved by mistake: how far the farthest drone is then from where it should "
        "be, and what is left of the margins. A minus is beyond the line.",
        {}};
    Table table{"sensitivity",
                "",
                {{"Change", 20},
                 {"Moves a drone by up to (m)", 17, true},
                 {"Geofence margin (m)", 15, true},
                 {"Audience margin (m)", 15, true},
                 {"Obstacle margin (m)", 15, true},
                 {"", 10}},
                {}};
    const auto margin = [](const std::optional<double>& m) { return m ? signed_text(*m, 2) : std::string(kAbsent); };
    for (const ReportSensitivity& s : report.sensitivities) {
        std::string change = s.change;
        if (const std::size_t minus = change.find(" -"); minus != std::string::npos) change.replace(minus, 2, " −");
        table.rows.push_back({{change, fixed_text(s.farthest_moved_m, 2), margin(s.geofence_margin_m),
                               margin(s.audience_margin_m), margin(s.obstacle_margin_m), s.held ? "held" : "BROKEN"},
                              !s.held});
    }
    section.blocks.emplace_back(std::move(table));
    return section;
}

Section lights_section(const Report& report) {
    const ReportLights& l = report.lights;
    Section section{
        "lights",
        "Lights",
        "A flash is a pair of opposing changes of luminance. More than three a second of what fills the view "
        "can harm people with photosensitive epilepsy (WCAG 2.3.1).",
        {}};
    section.blocks.emplace_back(Facts{
        {{"Light keys, all drones", count_text(l.keys)},
         {"Most keys of a drone in a second", fixed_text(l.most_keys_per_s, 1) + " 1/s"},
         {"Fastest flashing of one lamp", fixed_text(l.fastest_flash_hz, 2) + " Hz"},
         {"Fastest flashing of the fleet", fixed_text(l.fleet_flash_hz, 2) + " Hz" +
                                               (l.fleet_flash_hz > 0.0 ? " at " + clock_text(l.fleet_flash_s) : "")}}});
    section.blocks.emplace_back(
        l.warning ? Words{"Warning: the fleet flashes more than three times a second. Warn the audience or change it.",
                          Tone::bad}
                  : Words{"The fleet as a whole never flashes more than three times a second.", Tone::good});
    return section;
}

Section files_section(const Report& report) {
    Section section{"files",
                    "Exported files",
                    "Each format was read back after writing and judged by code of its own. The separation is that of "
                    "the written numbers, after rounding.",
                    {}};
    Table table{"files",
                "",
                {{"Format", 14},
                 {"Files", 8, true},
                 {"Smallest separation (m)", 14, true},
                 {"Stated error (m)", 11, true},
                 {"Timing and remarks", 40},
                 {"", 9}},
                {}};
    std::vector<Words> problems;
    for (const ReportFormat& f : report.formats) {
        if (!f.skipped.empty()) {
            table.rows.push_back({{f.name, kAbsent, kAbsent, kAbsent, "not written: " + f.skipped, "skipped"}});
            continue;
        }
        table.rows.push_back(
            {{f.name, count_text(f.files), f.min_separation_m ? fixed_text(*f.min_separation_m, 3) : kAbsent,
              fixed_text(f.position_error_m, 4), f.timing, f.held ? "held" : "BROKEN"},
             !f.held});
        for (const std::string& problem : f.problems) problems.push_back({f.name + ": " + problem, Tone::bad});
    }
    section.blocks.emplace_back(std::move(table));
    for (Words& problem : problems) section.blocks.emplace_back(std::move(problem));
    return section;
}

}  // namespace aerogram::exporter
