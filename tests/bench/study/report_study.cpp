// The numbers of a show's report without the planner: CPU seconds and memory.
#include <stdexcept>

#include "export/outgoing/planned_show.hpp"
#include "export/report/report_files.hpp"
#include "tests/bench/study/study.hpp"
#include "tests/unit/export/large_show.hpp"

namespace aerogram::study {
namespace {

Json report_study(const Arguments& arguments) {
    const std::size_t n = arguments.count(0);
    Run run;
    run.threads = static_cast<unsigned>(arguments.number("threads", 2));
    const planner::FlightPlan plan = exporter::large::show(n);
    const exporter::PlannedShow show(plan);
    const exporter::Judgement judgement;
    const MemoryRise memory;
    const double start_s = cpu_s();
    const auto report = exporter::make_report({show, judgement, "", true, {}, {}}, run);
    const double made_s = cpu_s();
    if (!report) throw std::runtime_error(report.error().message);
    if (report->emergencies.size() != static_cast<std::size_t>(plan.duration_ms() / 1000) + 1)
        throw std::runtime_error("a second has no emergency");
    const double peak_mb = memory.peak_mb();
    const std::string text = exporter::report_json(*report);
    return Json{}
        .add("n", static_cast<double>(n))
        .add("show_s", static_cast<double>(plan.duration_ms()) / 1000.0)
        .add("report_cpu_s", made_s - start_s)
        .add("json_cpu_s", cpu_s() - made_s)
        .add("json_mb", static_cast<double>(text.size()) / 1e6)
        .add("peak_mb", peak_mb);
}

const Study kReport{"report", "N [--threads 2]", "50", report_study};

}  // namespace
}  // namespace aerogram::study
