#pragma once
#include <optional>
#include <span>
#include <vector>

#include "geo/result.hpp"
#include "geo/run.hpp"
#include "planner/mission/mission.hpp"
#include "planner/motion/act.hpp"
#include "planner/transition/spectral.hpp"

namespace aerogram::planner {

/// One leg's wishes, from keyframe j to keyframe j + 1.
struct FlowLeg {
    FlowOptions options;               ///< `corner` is about the keyframe this leg arrives at
    std::optional<double> duration_s;  ///< the leg's share of the whole time
};
struct Flow {
    Lattice lattice;
    std::vector<std::size_t> keyframe_knots;  ///< knot where keyframe j stands or is passed: first 0, last K-3
};

/// One act through m >= 2 keyframes without stopping between them; at rest at the first and last.
/// Catmull-Rom with tension on positions, or (FlowOf::spectral) on coefficients and rotations in the cumulative form
/// M(t) = R2^{c2} R1^{c1+c2} R0^{c0+c1+c2} M0 (DESIGN.md 7.8), reordering and signs chained over the legs.
/// A flow is spectral when any of its legs asks for it; details in flow_spectral.hpp, the clock in flow_clock.hpp.
/// Time runs along the path by one smooth clock u(t) whose knots hit the keyframes.
/// Properties: (1) keyframes are met at their knots to 1e-9 m (2) position, velocity and acceleration are continuous (a
/// cubic B-spline); at a corner the path may turn sharply only by slowing to rest there (3) rigid motions commute (4)
/// deterministic. Source: Takahashi et al. 2009, section 4.1, equation 5.
/// @param keyframes  m keyframes with the same n.  @param legs  m - 1.  @param rows_per_leg  about; >= 12.
/// Errors: stopped.
Result<Flow> flow_transition(std::span<const SpectralKeyframe> keyframes, std::span<const FlowLeg> legs,
                             const SpectralOptions& spectral, std::size_t rows_per_leg, const Run& run);

}  // namespace aerogram::planner
