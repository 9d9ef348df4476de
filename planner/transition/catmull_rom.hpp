#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "geo/vec3.hpp"
#include "planner/mission/mission.hpp"

namespace aerogram::planner {

/// The four keyframes that shape one leg of a flow. At the ends of the flow and at corners the end itself stands in for
/// the neighbour beyond it, so the curve comes in along the chord.
struct CatmullRomLeg {
    std::size_t before = 0, from = 0, to = 0, after = 0;
    double tension_from = 0.5, tension_to = 0.5;
};
/// Legs with the same tension on both sides of a keyframe are equation 5; where a designer gives two legs different
/// tensions the keyframe between them has their mean, which keeps the velocity continuous.
/// @param options  one a leg; `corner` is about the keyframe the leg arrives at.
[[nodiscard]] std::vector<CatmullRomLeg> catmull_rom_legs(std::span<const FlowOptions> options);

/// What each of the four keyframes counts; the sum is 1.
struct CatmullRomWeights {
    double before = 0.0, from = 0.0, to = 0.0, after = 0.0;

    [[nodiscard]] Vec3 blend(const Vec3& at_before, const Vec3& at_from, const Vec3& at_to,
                             const Vec3& at_after) const {
        return before * at_before + from * at_from + to * at_to + after * at_after;
    }
};
/// Source: Takahashi et al. 2009, equation 5.  @param t  share of the leg, [0, 1].
[[nodiscard]] inline CatmullRomWeights catmull_rom_weights(const CatmullRomLeg& leg, double t) {
    const double t2 = t * t, t3 = t2 * t;
    const double leave = leg.tension_from * (t - 2.0 * t2 + t3), arrive = leg.tension_to * (t3 - t2);
    const double rise = 3.0 * t2 - 2.0 * t3;
    return {-leave, 1.0 - rise - arrive, rise + leave, arrive};
}

}  // namespace aerogram::planner
