#include "export/report/report_content.hpp"
#include "export/report/report_words.hpp"

namespace aerogram::exporter {
namespace {

Chart nearest_chart(const Report& report) {
    Chart chart;
    chart.name = "nearest";
    chart.title = "Distance of the closest pair";
    chart.unit = "m";
    chart.x_unit = "min:s";
    chart.x = report.times_s;
    chart.lines = {{"closest pair", report.nearest_m}};
    chart.limits = {{"smallest allowed", report.limits.min_separation_m}};
    chart.bands = keyframe_bands(report);
    return chart;
}

Chart histogram_chart(const Report& report) {
    Chart chart;
    chart.name = "histogram";
    chart.title = "How often the nearest neighbour is how far away, drone-instants (last bar: all beyond)";
    chart.unit = "count";
    chart.bars = true;
    chart.x_unit = "m";
    ChartLine counts{"drone-instants", {}};
    for (std::size_t i = 0; i < report.histogram.size(); ++i) {
        chart.x.push_back(static_cast<double>(i) * report.histogram_step_m);
        counts.values.push_back(static_cast<double>(report.histogram[i]));
    }
    chart.lines = {std::move(counts)};
    return chart;
}

Table pairs_table(const std::string& name, const std::string& caption, const char* first, const char* second,
                  const std::vector<ReportEncounter>& pairs, double smallest_m) {
    Table table{name,
                caption,
                {{"", 4, true},
                 {first, 9, true},
                 {second, 9, true},
                 {"Time", 9, true},
                 {"Separation (m)", 13, true},
                 {"Margin (m)", 11, true},
                 {"Horizontal (m)", 13, true},
                 {"Vertical (m)", 12, true},
                 {"Place x, y, z (m)", 20, true}},
                {}};
    for (const ReportEncounter& e : pairs) {
        const int digits = digits_of_margin(e.distance_m - smallest_m, 3);
        table.rows.push_back(
            {{std::to_string(table.rows.size() + 1), std::to_string(e.first), std::to_string(e.second),
              clock_text(e.time_s), fixed_text(e.distance_m, digits), signed_text(e.distance_m - smallest_m, digits),
              fixed_text(e.horizontal_m, 3), fixed_text(e.vertical_m, 3), place_text(e.place_m)},
             e.distance_m < smallest_m});
    }
    return table;
}

}  // namespace

Section distances_section(const Report& report) {
    Section section{"distances",
                    "Distances between drones",
                    "Separation divides the vertical part by the downwash factor " +
                        fixed_text(report.limits.downwash, 2) +
                        ". Drones that stand on the ground together do not count.",
                    {}};
    if (report.drones > 1) {
        section.blocks.emplace_back(nearest_chart(report));
        section.blocks.emplace_back(histogram_chart(report));
    }
    if (report.encounters.empty()) {
        section.blocks.emplace_back(Words{"No two drones come near each other.", Tone::plain});
    } else {
        section.blocks.emplace_back(pairs_table(
            "encounters",
            counted(report.encounters.size(), "closest encounter", "closest encounters") + ", one a pair and approach",
            "Drone", "Drone", report.encounters, report.limits.min_separation_m));
    }
    const std::string column = "within " + fixed_text(report.alignment_radius_m, 2) + " m sideways and " +
                               fixed_text(report.alignment_height_m, 2) + " m below another";
    if (report.alignments.empty()) {
        section.blocks.emplace_back(Words{"Downwash: no drone is " + column + ".", Tone::good});
    } else {
        section.blocks.emplace_back(pairs_table("alignments", "Downwash: drones " + column, "Upper", "Lower",
                                                report.alignments, report.limits.min_separation_m));
    }
    return section;
}

}  // namespace aerogram::exporter
