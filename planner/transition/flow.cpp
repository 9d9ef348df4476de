#include "planner/transition/flow.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "geo/contract.hpp"
#include "planner/transition/catmull_rom.hpp"
#include "planner/transition/flow_clock.hpp"
#include "planner/transition/flow_spectral.hpp"

namespace aerogram::planner {
namespace {

void check(std::span<const SpectralKeyframe> keyframes, std::span<const FlowLeg> legs) {
    AEROGRAM_REQUIRE(keyframes.size() >= 2 && legs.size() + 1 == keyframes.size(), keyframes.size(), legs.size());
    const std::size_t n = keyframes[0].positions_m.size();
    AEROGRAM_REQUIRE(n >= 1);
    for (const SpectralKeyframe& k : keyframes) {
        AEROGRAM_REQUIRE(k.positions_m.size() == n, k.positions_m.size(), n);
        for (const Vec3& p : k.positions_m) AEROGRAM_REQUIRE(is_finite(p), p.x, p.y, p.z);
    }
}

void blend_positions(std::span<const SpectralKeyframe> keyframes, const CatmullRomLeg& leg, double share,
                     std::span<Vec3> out) {
    const CatmullRomWeights c = catmull_rom_weights(leg, share);
    for (std::size_t i = 0; i < out.size(); ++i) {
        out[i] = c.blend(keyframes[leg.before].positions_m[i], keyframes[leg.from].positions_m[i],
                         keyframes[leg.to].positions_m[i], keyframes[leg.after].positions_m[i]);
    }
}

}  // namespace

Result<Flow> flow_transition(std::span<const SpectralKeyframe> keyframes, std::span<const FlowLeg> legs,
                             const SpectralOptions& spectral, std::size_t rows_per_leg, const Run& run) {
    check(keyframes, legs);
    const std::size_t n = keyframes[0].positions_m.size();
    std::vector<FlowOptions> options;
    for (const FlowLeg& leg : legs) options.push_back(leg.options);
    const std::vector<CatmullRomLeg> path = catmull_rom_legs(options);
    std::optional<SpectralFlow> bases;
    if (std::ranges::any_of(options, [](const FlowOptions& o) { return o.of == FlowOf::spectral; })) {
        Result<SpectralFlow> built = SpectralFlow::through(keyframes, path, spectral, run);
        if (!built) return built.error();
        bases = std::move(*built);
    }

    std::vector<std::size_t> knots = flow_knots(keyframes, legs, rows_per_leg);
    const FlowClock clock(knots, legs);
    Points samples_m((knots.back() + 1) * n);
    parallel_for(knots.back() + 1, run, "flow", [&](std::size_t knot) {
        const std::span<Vec3> row(samples_m.data() + knot * n, n);
        const FlowPlace place = clock.at(static_cast<double>(knot));
        if (bases) {
            bases->at(place.leg, place.share, row);
        } else {
            blend_positions(keyframes, path[place.leg], place.share, row);
        }
    });
    if (run.stopped()) return stopped_error();
    for (std::size_t j = 0; j < keyframes.size(); ++j) {  // exact, not to rounding error
        std::ranges::copy(keyframes[j].positions_m, samples_m.begin() + static_cast<std::ptrdiff_t>(knots[j] * n));
    }
    return Flow{lattice_through(samples_m, n), std::move(knots)};
}

}  // namespace aerogram::planner
