#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "planner/transition/flow.hpp"

namespace aerogram::planner {

/// The knots at which keyframes are met: [0, ..., total].
/// A leg's share of the time is its duration_s; legs without one take the time that gives them the same mean speed as
/// the legs with one, where a leg's length is the fourth-power mean of its drones' straight distances (between the mean
/// and the farthest), at least a tenth of the mean leg, and a leg with one end at rest counts 3/2 as long, with two
/// 15/8. The total, rows_per_leg a leg or up to a quarter more, is the one whose whole knots come closest to the
/// shares; a leg has at least kLeastKnotsPerLeg.
/// @param keyframes  m.  @param legs  m - 1.
[[nodiscard]] std::vector<std::size_t> flow_knots(std::span<const SpectralKeyframe> keyframes,
                                                  std::span<const FlowLeg> legs, std::size_t rows_per_leg);
inline constexpr std::size_t kLeastKnotsPerLeg = 8;

/// Where on the path the fleet is.
struct FlowPlace {
    std::size_t leg = 0;
    double share = 0.0;  ///< of the leg, [0, 1]
};

/// The one clock of a flow: u(knot) = leg + share.
/// A quintic a leg; at the ends and at corners u' = u'' = 0; at keyframes that are passed u'' = 0 and u' is the
/// harmonic middle of the two legs' cruising speeds (the mean speed, times 3/2 for a leg with one end at rest), at most
/// twice either mean. Properties: (1) u is keyframe number j at keyframe_knots[j] (2) u is twice continuously
/// differentiable (3) u does not decrease: the quintic is monotone whenever its end slopes are at most twice its mean.
class FlowClock {
  public:
    /// @param legs  keyframe_knots.size() - 1.
    FlowClock(std::vector<std::size_t> keyframe_knots, std::span<const FlowLeg> legs);

    /// @param knot  [0, last keyframe knot]; need not be whole.
    [[nodiscard]] FlowPlace at(double knot) const;

  private:
    std::vector<std::size_t> knots_;
    std::vector<double> slopes_;  ///< u' at each keyframe, per knot
};

}  // namespace aerogram::planner
