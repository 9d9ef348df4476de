// Whole shows: planning a mission of two words, sampling the plan, exporting it in every format (which reads all files
// back and judges them). Plans must be certified, exports must hold.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "export/export_show.hpp"
#include "geo/units.hpp"
#include "missions.hpp"
#include "planner/plan.hpp"

namespace aerogram {
namespace {

using planner::FlightPlan;

std::size_t fleet(const benchmark::State& state) {
    return static_cast<std::size_t>(state.range(0));
}

void plan_words(benchmark::State& state, const char* method) {
    const planner::Mission mission = bench::words(fleet(state), method);
    for (auto _ : state) {
        const auto plan = planner::plan(mission, {}, Run{});
        if (!plan.ok() || !plan->certificate.certified() || plan->keyframes.size() != 2) {
            state.SkipWithError(plan.ok() ? "not certified" : plan.error().message.c_str());
            break;
        }
        state.counters["show_s"] = seconds_from_ms(plan->duration_ms());
    }
}

/// One frame a time step of 1/30 s. At the end of the show everybody stands on the own pad.
void sample_frames(benchmark::State& state) {
    const FlightPlan plan = planner::plan(bench::words(fleet(state)), {}, Run{}).value();
    const double end_s = seconds_from_ms(plan.duration_ms());
    std::vector<planner::DroneState> frame(plan.drones());
    double t_s = 0.0;
    for (auto _ : state) {
        t_s = t_s >= end_s ? 0.0 : t_s + 1.0 / 30.0;
        planner::sample(plan, t_s, frame);
        benchmark::DoNotOptimize(frame.data());
    }
    planner::sample(plan, end_s, frame);
    double off_m = 0.0;
    for (std::size_t d = 0; d < frame.size(); ++d)
        off_m = std::max(off_m, glm::distance(frame[d].motion.position_m, plan.pads_m[d]));
    if (off_m > 1e-9) state.SkipWithError("the show does not end on the pads");
    state.counters["states_per_s"] = benchmark::Counter(
        static_cast<double>(state.iterations()) * static_cast<double>(plan.drones()), benchmark::Counter::kIsRate);
}

void export_words(benchmark::State& state) {
    const FlightPlan plan = planner::plan(bench::words(fleet(state)), {}, Run{}).value();
    const auto folder =
        std::filesystem::temp_directory_path() / ("aerogram-bench-" + std::to_string(::getpid())) / "show";
    for (auto _ : state) {
        const auto show =
            exporter::export_show(plan, folder, {.formats = {}, .best_effort = false, .drones = {}}, Run{});
        const bool held = show.ok() && show->certified && std::ranges::all_of(show->formats, [&](const auto& format) {
                              const bool not_for_many = format.name == "crazyflie" && plan.drones() > 255;
                              return (format.skipped.empty() || not_for_many) && format.judgement.held();
                          });
        if (!held) {
            state.SkipWithError(show.ok() ? "a format was skipped or does not hold" : show.error().message.c_str());
            break;
        }
    }
    std::filesystem::remove_all(folder.parent_path());
}

BENCHMARK_CAPTURE(plan_words, straight, "straight")->Arg(10)->Arg(60)->Arg(300)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plan_words, spectral, "spectral")->Arg(10)->Arg(60)->Arg(300)->Unit(benchmark::kMillisecond);
BENCHMARK(sample_frames)->Arg(10)->Arg(60)->Arg(300)->Unit(benchmark::kMicrosecond);
BENCHMARK(export_words)->Arg(10)->Arg(60)->Arg(300)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace aerogram
