// Formations: letters, a sphere, a helix, a grid, areas, skins and volumes (10,000 drones are to take at most 2 s).
// Each run checks the number of slots and their smallest spacing.
#include <benchmark/benchmark.h>

#include "planner/formation/formation.hpp"
#include "tests/unit/planner/formation/missions.hpp"

namespace aerogram::planner {
namespace {

using namespace testing;

void measure(benchmark::State& state, const Source& source) {
    const auto n = static_cast<std::size_t>(state.range(0));
    const Mission mission = mission_of({part_of(source, n)});
    double spacing_m = 0.0;
    for (auto _ : state) {
        const auto formation = build(mission);
        if (!formation.ok() || formation->points_m.size() != n) {
            state.SkipWithError("no formation of n slots");
            break;
        }
        spacing_m = formation->smallest_spacing_m;
        benchmark::DoNotOptimize(formation->points_m.data());
    }
    if (!(spacing_m >= mission.limits.formation_spacing_m - 1e-9)) state.SkipWithError("slots are too close");
    state.counters["spacing_m"] = spacing_m;
}

void formation_of_text(benchmark::State& state) {
    measure(state, text("HELLO"));
}
void formation_of_sphere(benchmark::State& state) {
    measure(state, shape(ShapeKind::sphere));
}
void formation_of_helix(benchmark::State& state) {
    measure(state, shape(ShapeKind::helix));
}
void formation_of_grid(benchmark::State& state) {
    measure(state, shape(ShapeKind::grid));
}

void formation_of_star(benchmark::State& state) {
    measure(state, shape(ShapeKind::star));
}
void formation_of_disc_outline(benchmark::State& state) {
    ShapeSource source = shape(ShapeKind::disc);
    source.area_style = AreaStyle::outline;
    measure(state, source);
}
void formation_of_torus(benchmark::State& state) {
    ShapeSource source = shape(ShapeKind::torus);
    source.inner = 0.25;
    measure(state, source);
}
void formation_of_cube_volume(benchmark::State& state) {
    ShapeSource source = shape(ShapeKind::cube);
    source.solid_style = SolidStyle::volume;
    measure(state, source);
}

BENCHMARK(formation_of_text)->Arg(10)->Arg(60)->Arg(300)->Unit(benchmark::kMillisecond);
BENCHMARK(formation_of_sphere)->Arg(10)->Arg(60)->Arg(300)->Unit(benchmark::kMillisecond);
BENCHMARK(formation_of_helix)->Arg(10)->Arg(60)->Arg(300)->Unit(benchmark::kMillisecond);
BENCHMARK(formation_of_grid)->Arg(10)->Arg(60)->Arg(300)->Unit(benchmark::kMillisecond);
BENCHMARK(formation_of_star)->Arg(300)->Arg(10'000)->Unit(benchmark::kMillisecond);
BENCHMARK(formation_of_torus)->Arg(300)->Arg(10'000)->Unit(benchmark::kMillisecond);
BENCHMARK(formation_of_cube_volume)->Arg(300)->Arg(10'000)->Unit(benchmark::kMillisecond);
BENCHMARK(formation_of_disc_outline)->Arg(300)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace aerogram::planner
