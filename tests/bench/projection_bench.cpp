// The separation projection on random matchings, the hardest maps there are. Each result is checked by dense sampling
// and against the ends it must keep.
#include <benchmark/benchmark.h>

#include "acts.hpp"
#include "planner/separation/projection.hpp"

namespace aerogram::planner {
namespace {

void project(benchmark::State& state, Points from_m, Points to_m) {
    const auto n = static_cast<std::size_t>(state.range(0));
    for (Vec3& p : from_m) p.z += 40.0;
    for (Vec3& p : to_m) p.z += 60.0;
    const Lattice input =
        bench::lattice_of({from_m, testing::shuffled(to_m, n), profile_rows(ProfileKind::minimum_jerk, bench::kRows)});
    ProjectionTask task;
    task.required_m = planned_separation_m(Limits{});
    task.samples_per_interval = 2;
    Projected projected;
    for (auto _ : state) {
        projected = project_separation(input, task, Run{}).value();
        benchmark::DoNotOptimize(projected.lattice.points_m.data());
    }
    const Motion motion = projected.lattice;
    if (!projected.separated || bench::sampled_separation(motion, {}) < task.required_m)
        state.SkipWithError("not separated");
    if (start_positions(motion) != start_positions(Motion{input}) ||
        end_positions(motion) != end_positions(Motion{input}))
        state.SkipWithError("the ends moved");
    state.counters["rounds"] = projected.rounds;
}

void project_sheet_to_sheet(benchmark::State& state) {
    const auto n = static_cast<std::size_t>(state.range(0));
    project(state, testing::sheet(n), testing::sheet(n));
}
void project_sheet_to_sphere(benchmark::State& state) {
    const auto n = static_cast<std::size_t>(state.range(0));
    project(state, testing::sheet(n), testing::ball(n));
}

BENCHMARK(project_sheet_to_sheet)->Arg(10)->Arg(60)->Arg(300)->Unit(benchmark::kMillisecond);
BENCHMARK(project_sheet_to_sphere)->Arg(10)->Arg(60)->Arg(300)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace aerogram::planner
