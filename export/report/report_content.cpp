#include "export/report/report_content.hpp"

#include "export/report/report_words.hpp"

namespace aerogram::exporter {

ReportContent report_content(const Report& report) {
    ReportContent content{cover_of(report), report.program + " " + report.version, short_hash(report.show_hash), {}};
    for (const auto section :
         {rules_section, over_time_section, distances_section, places_section, turns_section, energy_section,
          emergency_section, sensitivity_section, lights_section, files_section, glossary_section})
        content.sections.push_back(section(report));
    return content;
}

std::vector<ChartBand> keyframe_bands(const Report& report) {
    std::vector<ChartBand> bands;
    for (const OutgoingKeyframe& keyframe : report.keyframes)
        bands.push_back({keyframe.name, static_cast<double>(keyframe.stands_from_ms) / 1e3,
                         static_cast<double>(keyframe.stands_to_ms) / 1e3});
    return bands;
}

Section glossary_section(const Report&) {
    Table table{"words", "", {{"Word", 2}, {"Meaning", 8}}, {}};
    const auto add = [&](const char* word, const char* meaning) { table.rows.push_back({{word, meaning}}); };
    add("Certified",
        "Every rule was bounded for every instant between first take-off and last landing, not at samples.");
    add("Separation",
        "Distance of two drones with the vertical part divided by the downwash factor. Drones standing on the ground "
        "together do not count.");
    add("Limit, worst, margin",
        "What is allowed; what the show does at its worst; how far that is on the good side. A minus margin is "
        "broken.");
    add("Allowance", "What the rounding of the judged file may add to a worst value before a rule counts as broken.");
    add("Show time", "Minutes and seconds since the first take-off.");
    add("Place", "Show frame, metres: x to the right and y away from the audience, z above the origin's ground.");
    add("Altitude", "Height above the drone's own home.");
    add("Show hash",
        "SHA-256 over geometry, origin, heading, fence, limits and lights. The same digits stand in every file that "
        "can hold them, and in the manifest, for the "
        "show; other digits mean another show.");
    add("Flight volume", "Hull of every place that a drone is over, up to the highest place.");
    add("Contingency volume", "Where a drone may come that has left the flight volume before it is stopped.");
    add("Ground-risk volume", "Where a drone could fall: as much wider again as the contingency volume is high.");
    add("Reserve", "Share of the endurance that is left at landing.");
    return {"words", "What the words mean", "", {table}};
}

}  // namespace aerogram::exporter
