#include <algorithm>
#include <cmath>
#include <numeric>

#include "export/report/report_content.hpp"
#include "export/report/report_words.hpp"

namespace aerogram::exporter {
namespace {

constexpr std::size_t kAllOnPaper = 200;  ///< drones; larger fleets are summarised by time
constexpr std::size_t kMostGroups = 60;

std::vector<std::size_t> ordered(const Report& report, double ReportTurn::*when) {
    std::vector<std::size_t> order(report.turns.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        const ReportTurn &p = report.turns[a], &q = report.turns[b];
        return p.*when != q.*when ? p.*when < q.*when : p.drone < q.drone;
    });
    return order;
}

Table each_drone(const Report& report) {
    Table table{"turns",
                "Every drone in the order of take-off",
                {{"", 6, true},
                 {"Drone", 8, true},
                 {"Leaves", 10, true},
                 {"Lands", 10, true},
                 {"Aloft", 10, true},
                 {"Home x, y (m)", 17, true},
                 {"Lands at x, y (m)", 18, true}},
                {}};
    table.side_by_side = 2;
    const auto at = [](const Vec3& p) { return fixed_text(p.x, 1) + ", " + fixed_text(p.y, 1); };
    for (const std::size_t i : ordered(report, &ReportTurn::leaves_s)) {
        const ReportTurn& t = report.turns[i];
        table.rows.push_back({{std::to_string(table.rows.size() + 1), std::to_string(t.drone), clock_text(t.leaves_s),
                               clock_text(t.lands_s), clock_text(t.lands_s - t.leaves_s), at(t.home_m), at(t.land_m)}});
    }
    return table;
}

/// Drones that turn within the same `step_s` seconds, as few steps as fit on paper.
Table groups(const Report& report, double ReportTurn::*when, const char* name, const char* caption, const char* word) {
    Table table{name, caption, {{word, 18, true}, {"Drones", 10, true}, {"Numbers", 60}}, {}};
    const std::vector<std::size_t> order = ordered(report, when);
    for (double step_s = 0.1; table.rows.empty() || table.rows.size() > kMostGroups; step_s *= 2.0) {
        table.rows.clear();
        for (std::size_t i = 0; i < order.size();) {
            const double from = report.turns[order[i]].*when;
            const double until = (std::floor(from / step_s + 1e-9) + 1.0) * step_s - 1e-9;
            std::vector<std::size_t> numbers;
            double last = from;
            for (; i < order.size() && (numbers.empty() || report.turns[order[i]].*when < until); ++i) {
                last = report.turns[order[i]].*when;
                numbers.push_back(report.turns[order[i]].drone);
            }
            std::sort(numbers.begin(), numbers.end());
            const std::string begin = clock_text(from), end = clock_text(last);
            table.rows.push_back(
                {{begin == end ? begin : begin + " to " + end, count_text(numbers.size()), ranges_text(numbers)}});
        }
        if (order.empty()) break;
    }
    return table;
}

}  // namespace

Section turns_section(const Report& report) {
    Section section{
        "turns", "Take-off and landing order", "Show time of the first and the last instant off the ground.", {}};
    if (report.turns.size() <= kAllOnPaper) {
        section.blocks.emplace_back(each_drone(report));
        return section;
    }
    section.blocks.emplace_back(groups(report, &ReportTurn::leaves_s, "takeoffs", "Take-off", "Leaves"));
    section.blocks.emplace_back(groups(report, &ReportTurn::lands_s, "landings", "Landing", "Lands"));
    section.blocks.emplace_back(Words{"Every single drone is listed in report.json and in report.html.", Tone::note});
    Table all = each_drone(report);
    all.only_on_screen = true;
    section.blocks.emplace_back(std::move(all));
    return section;
}

}  // namespace aerogram::exporter
