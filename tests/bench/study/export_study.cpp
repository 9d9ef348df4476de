// Export and verify of a whole show without the planner: CPU seconds and memory.
#include <filesystem>
#include <stdexcept>

#include "export/export_show.hpp"
#include "export/verify_show.hpp"
#include "tests/bench/study/study.hpp"
#include "tests/unit/export/large_show.hpp"

namespace aerogram::study {
namespace {

namespace fs = std::filesystem;

Json export_study(const Arguments& arguments) {
    const std::size_t n = arguments.count(0);
    const std::string format = arguments.option("format", "all");
    Run run;
    run.threads = static_cast<unsigned>(arguments.number("threads", 2));
    std::vector<std::string> names;
    if (format != "all") names.push_back(format);
    const planner::FlightPlan plan = exporter::large::show(n);
    const fs::path folder = fs::temp_directory_path() / ("aerogram-export-study-" + std::to_string(n) + "-" + format);
    const MemoryRise memory;
    const double start_s = cpu_s();
    const auto exported =
        exporter::export_show(plan, folder, {.formats = names, .best_effort = false, .drones = {}}, run);
    const double exported_s = cpu_s();
    if (!exported) throw std::runtime_error(exported.error().message);
    const auto verified = exporter::verify_path(folder, run);
    const double verified_s = cpu_s();
    fs::remove_all(folder);
    if (!verified || !verified->held()) throw std::runtime_error("what was exported does not hold");
    return Json{}
        .add("n", static_cast<double>(n))
        .add("format", format)
        .add("show_s", static_cast<double>(plan.duration_ms()) / 1000.0)
        .add("export_cpu_s", exported_s - start_s)
        .add("verify_cpu_s", verified_s - exported_s)
        .add("peak_mb", memory.peak_mb());
}

const Study kExport{"export", "N [--format all] [--threads 2]", "100", export_study};

}  // namespace
}  // namespace aerogram::study
