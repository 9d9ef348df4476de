// Spectral transitions and flows: preparing one, and evaluating a frame. Each result is checked against the keyframes,
// and halfway against the size the coefficient norms give.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "planner/transition/flow.hpp"

namespace aerogram::planner {
namespace {

/// A helix of `turns` turns, n drones, 60 m tall; joined to the drones up to three places on.
SpectralKeyframe helix(std::size_t n, double turns, double radius_m) {
    SpectralKeyframe out;
    for (std::size_t i = 0; i < n; ++i) {
        const double u = static_cast<double>(i) / static_cast<double>(n);
        const double angle = 2.0 * std::numbers::pi * turns * u;
        out.positions_m.push_back({radius_m * std::cos(angle), radius_m * std::sin(angle), 20.0 + 60.0 * u});
    }
    out.graph.n = n;
    for (std::size_t a = 0; a < n; ++a) {
        for (std::size_t b = a + 1; b < std::min(n, a + 4); ++b) {
            out.graph.edges.push_back({static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b),
                                       1.0 / glm::distance(out.positions_m[a], out.positions_m[b])});
        }
    }
    return out;
}

std::size_t fleet(const benchmark::State& state) {
    return static_cast<std::size_t>(state.range(0));
}

double farthest(const Points& a, const Points& b) {
    double worst = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, glm::distance(a[i], b[i]));
    return worst;
}

bool meets_ends(const SpectralTransition& transition, const SpectralKeyframe& from, const SpectralKeyframe& to) {
    Points at(from.positions_m.size());
    transition.at(0.0, at);
    const double start = farthest(at, from.positions_m);
    transition.at(1.0, at);
    return std::max(start, farthest(at, to.positions_m)) < 1e-9;
}

void spectral_prepare(benchmark::State& state) {
    const SpectralKeyframe from = helix(fleet(state), 1.5, 20.0), to = helix(fleet(state), 4.2, 12.0);
    for (auto _ : state) {
        const auto transition = SpectralTransition::between(from, to, {}, Run{});
        if (!transition.ok() || !meets_ends(transition.value(), from, to)) {
            state.SkipWithError("the keyframes were missed");
            break;
        }
    }
}
BENCHMARK(spectral_prepare)->Arg(10)->Arg(60)->Arg(300)->Unit(benchmark::kMillisecond);

void spectral_frame(benchmark::State& state) {
    const SpectralKeyframe from = helix(fleet(state), 1.5, 20.0), to = helix(fleet(state), 4.2, 12.0);
    const auto transition = SpectralTransition::between(from, to, {}, Run{});
    Points at(fleet(state)), again(fleet(state));
    double t = 0.0;
    for (auto _ : state) {
        t = t >= 1.0 ? 0.0 : t + 1.0 / 128.0;
        transition.value().at(t, at);
        benchmark::DoNotOptimize(at.data());
    }
    transition.value().at(t, again);
    if (at != again || !meets_ends(transition.value(), from, to))
        state.SkipWithError("frames do not repeat or miss the keyframes");
    state.counters["frames_per_s"] =
        benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK(spectral_frame)->Arg(10)->Arg(60)->Arg(300)->Unit(benchmark::kMicrosecond);

void flow(benchmark::State& state, FlowOf of) {
    const std::size_t n = fleet(state);
    const std::vector<SpectralKeyframe> keyframes{helix(n, 1.5, 20.0), helix(n, 4.2, 12.0), helix(n, 2.0, 25.0),
                                                  helix(n, 0.5, 30.0)};
    std::vector<FlowLeg> legs(3);
    for (FlowLeg& leg : legs) leg.options.of = of;
    for (auto _ : state) {
        const auto flown = flow_transition(keyframes, legs, {}, 20, Run{});
        bool met = flown.ok();
        for (std::size_t j = 0; met && j < keyframes.size(); ++j) {
            const std::size_t knot = flown->keyframe_knots[j];
            Points at(n);
            for (std::size_t i = 0; i < n; ++i) {
                const Lattice& l = flown->lattice;
                at[i] = knot_value(l.at(knot, i), l.at(knot + 1, i), l.at(knot + 2, i));
            }
            met = farthest(at, keyframes[j].positions_m) < 1e-9;
        }
        if (!met) {
            state.SkipWithError("a keyframe was missed");
            break;
        }
    }
}
BENCHMARK_CAPTURE(flow, positions, FlowOf::positions)->Arg(10)->Arg(60)->Arg(300)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(flow, spectral, FlowOf::spectral)->Arg(10)->Arg(60)->Arg(300)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace aerogram::planner
