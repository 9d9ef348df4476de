// Timing and the continuous-time certificate of one act. Bounds are checked against dense sampling, times against the
// limits they must just reach, certificates against what the act is known to do.
#include <benchmark/benchmark.h>

#include <algorithm>

#include "acts.hpp"
#include "geo/units.hpp"
#include "planner/motion/certificate.hpp"

namespace aerogram::planner {
namespace {

constexpr double kBeyond_m = 4.4;  // twice the sheet's spacing

std::size_t fleet(const benchmark::State& state) {
    return static_cast<std::size_t>(state.range(0));
}

void bound(benchmark::State& state, const Motion& motion) {
    const double sampled_m = std::min(bench::sampled_separation(motion, {}), kBeyond_m);
    double bound_m = 0.0;
    for (auto _ : state) {
        bound_m = bound_separation(motion, 1.0, {}, kBeyond_m, Run{}).value().lower_bound_m;
        benchmark::DoNotOptimize(bound_m);
    }
    if (!(bound_m <= sampled_m && bound_m >= 0.98 * sampled_m)) state.SkipWithError("sampling finds something else");
    state.counters["bound_m"] = bound_m;
}
void bound_of_straight(benchmark::State& state) {
    bound(state, bench::sheet_to_ball(fleet(state)));
}
void bound_of_lattice(benchmark::State& state) {
    bound(state, bench::lattice_of(bench::sheet_to_ball(fleet(state))));
}

double over_limit(const Motion& motion, Millis duration_ms, const Limits& limits) {
    const Extremes e = extremes(motion, seconds_from_ms(duration_ms));
    return std::max({e.speed_horizontal_mps / limits.speed_horizontal_mps, e.speed_up_mps / limits.speed_up_mps,
                     e.speed_down_mps / limits.speed_down_mps, e.acceleration_mps2 / limits.acceleration_mps2,
                     e.jerk_mps3 / limits.jerk_mps3});
}
/// At the shortest duration all limits hold, a thousandth of a second less breaks one.
void timing_of_lattice(benchmark::State& state) {
    const Motion motion = bench::lattice_of(bench::sheet_to_ball(fleet(state)));
    ShortestDuration shortest;
    for (auto _ : state) {
        shortest = shortest_duration(motion, {});
        benchmark::DoNotOptimize(shortest.duration_ms);
    }
    if (over_limit(motion, shortest.duration_ms, {}) > 1.0 + 1e-9 ||
        over_limit(motion, shortest.duration_ms - 1, {}) <= 1.0)
        state.SkipWithError("not the shortest legal duration");
    state.counters["duration_s"] = seconds_from_ms(shortest.duration_ms);
}

/// A whole act against limits, fence, audience and one obstacle.
void certify_act(benchmark::State& state) {
    const Straight straight = bench::sheet_to_ball(fleet(state));
    Surroundings around{geo::ShowFrame({}), {}, straight.from_m, {}};
    around.limits.min_separation_m = 1.4;  // ten drones stand 2.1 m apart on their sphere
    for (Vec3& p : around.pads_m) p.z = 0.0;
    const double far_m = 200.0;
    around.airspace.geofence_m = {{-far_m, -far_m}, {far_m, -far_m}, {far_m, far_m}, {-far_m, far_m}};
    around.airspace.audience_m = {{{-20, -90}, {20, -90}, {20, -60}, {-20, -60}}};
    around.airspace.obstacles = {{"tower", geo::Cylinder{{-80, 0}, 4.0}, 0.0, 25.0}};
    const Motion motion = bench::lattice_of(straight);
    const Act act{"to ball", ActRole::transit, Timing::free, 0, shortest_duration(motion, {}).duration_ms, motion};
    for (auto _ : state) {
        const auto certificate = certify(act, around, Run{});
        if (!certificate.ok() || !certificate->certified()) {
            state.SkipWithError("a sound act was not certified");
            break;
        }
    }
}

BENCHMARK(bound_of_straight)->Arg(10)->Arg(60)->Arg(300)->Unit(benchmark::kMillisecond);
BENCHMARK(bound_of_lattice)->Arg(10)->Arg(60)->Arg(300)->Unit(benchmark::kMillisecond);
BENCHMARK(timing_of_lattice)->Arg(10)->Arg(60)->Arg(300)->Unit(benchmark::kMillisecond);
BENCHMARK(certify_act)->Arg(10)->Arg(60)->Arg(300)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace aerogram::planner
