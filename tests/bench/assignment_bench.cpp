// Who flies where at the least squared cost. Each run checks the bijection, the certified gap and the pairwise
// property.
#include <benchmark/benchmark.h>

#include "planner/assignment/assignment.hpp"
#include "tests/unit/planner/assignment/instances.hpp"

namespace aerogram::planner {
namespace {

using namespace testing;

void measure(benchmark::State& state, const Points& from_m, const Points& to_m) {
    Assignment found;
    for (auto _ : state) {
        found = assign_shortest(from_m, to_m, {}, kEuclidean, Run{}).value();
        benchmark::DoNotOptimize(found.slot_of.data());
    }
    if (!is_bijection(found.slot_of)) state.SkipWithError("not a bijection");
    if (!(found.duality_gap <= 1e-12)) state.SkipWithError("the gap is not closed");
    if (!found.pairwise) state.SkipWithError("a pair crosses");
    state.counters["gap"] = found.duality_gap;
}

std::size_t drones(const benchmark::State& state) {
    return static_cast<std::size_t>(state.range(0));
}

void pads_to_letters(benchmark::State& state) {
    measure(state, pads(drones(state)), letters(drones(state)));
}
void sheet_to_sphere(benchmark::State& state) {
    measure(state, sheet(drones(state)), ball(drones(state)));
}
void sheet_to_tilted_ring(benchmark::State& state) {
    const std::size_t n = drones(state);
    measure(state, sheet(n), Motion{{0.5, 0.2, 0.1}, {5, 5, 40}}(circle(n, 0.4 * static_cast<double>(n))));
}
void random_to_random(benchmark::State& state) {
    const std::size_t n = drones(state);
    measure(state, random_points(n, 1, 20.0), random_points(n, 2, 20.0));
}
void crossing_check(benchmark::State& state) {
    const Points from_m = random_points(drones(state), 1);
    Points to_m = from_m;
    for (Vec3& p : to_m) p = p * 2.0 + Vec3{1, 2, 3};
    std::vector<SlotId> slot_of;
    for (std::size_t i = 0; i < from_m.size(); ++i) slot_of.emplace_back(i);
    std::optional<CrossingPair> crossing;
    for (auto _ : state) benchmark::DoNotOptimize(crossing = find_crossing(from_m, to_m, slot_of, kEuclidean));
    if (crossing) state.SkipWithError("found a crossing where all pairs move apart");
}

BENCHMARK(pads_to_letters)->Arg(10)->Arg(60)->Arg(300)->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK(sheet_to_sphere)->Arg(10)->Arg(60)->Arg(300)->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK(sheet_to_tilted_ring)->Arg(10)->Arg(60)->Arg(300)->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK(random_to_random)->Arg(10)->Arg(60)->Arg(300)->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK(crossing_check)->Arg(10)->Arg(60)->Arg(300)->Arg(1000)->Arg(10000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace aerogram::planner
