// A live sketch: from a drawing and the agents' positions to everybody's target (template, formation coordinates,
// correspondences, relaxation); and formation coordinates between formations. The paper reached 30 frames a second with
// 400 agents for its whole loop; `frames_per_s` is ours for this part. Each run checks its result.
#include <benchmark/benchmark.h>

#include <set>

#include "planner/formation_match.hpp"
#include "tests/unit/planner/assignment/instances.hpp"
#include "tests/unit/planner/sketch/strokes.hpp"

namespace aerogram::planner {
namespace {

using namespace testing;

bool all_different(const std::vector<std::size_t>& places) {
    return std::set<std::size_t>(places.begin(), places.end()).size() == places.size();
}

void live_sketch(benchmark::State& state) {
    const auto n = static_cast<std::size_t>(state.range(0));
    const std::vector<SketchStroke> drawing = sketches()[6].strokes;  // a face: a hole, an open line
    const std::vector<Vec2> agents = scattered(n, 1);
    SketchedFormation formed;
    for (auto _ : state) {
        formed = form(make_sketch(drawing).value(), agents);
        benchmark::DoNotOptimize(formed.targets.data());
    }
    if (formed.targets.size() != n || !all_different(formed.place)) state.SkipWithError("not one place an agent");
    state.counters["frames_per_s"] = benchmark::Counter(1.0, benchmark::Counter::kIsIterationInvariantRate);
}

void formation_coordinates(benchmark::State& state) {
    const auto n = static_cast<std::size_t>(state.range(0));
    const Points from_m = pads(n), to_m = ball(n);
    Assignment found;
    for (auto _ : state) {
        found = assign_formation_coordinates(from_m, to_m, {}, {}, kEuclidean, Run{}).value();
        benchmark::DoNotOptimize(found.slot_of.data());
    }
    if (std::set<SlotId>(found.slot_of.begin(), found.slot_of.end()).size() != n)
        state.SkipWithError("not a bijection");
}

BENCHMARK(live_sketch)->Arg(100)->Arg(400)->Arg(20'000)->Unit(benchmark::kMillisecond);
BENCHMARK(formation_coordinates)->Arg(100)->Arg(1'000)->Arg(10'000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace aerogram::planner
