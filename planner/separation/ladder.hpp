#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planner/separation/projection.hpp"

namespace aerogram::planner {

/// What the ladder may do beside projecting, and how it gets motions to work on.
struct LadderTask {
    ProjectionTask projection;  ///< of the first try; motion's step_s belongs to `rows`
    std::size_t rows = 63;      ///< control rows of the first try
    /// Control rows of the second; 0: stays at `rows` (flows, whose held knots belong to their rows). Steps and W
    /// scale.
    std::size_t fine_rows = 103;

    /// The motion before separation. Required.
    std::function<Result<Lattice>(std::size_t rows)> raw;
    /// The same when drone i flies to the target that was drone target_of[i]'s. Empty: nobody's target may change
    /// (`keep`, groups, pins).
    std::function<Result<Lattice>(std::size_t rows, std::span<const std::uint32_t> target_of)> swapped;
    /// Straight lines on the optimal assignment, where the mission leaves that free.
    std::optional<Straight> straight;
    bool may_stretch = true;  ///< the act may take longer than projection.motion says (no duration was given)
};

struct Separation {
    Motion motion;                                                     ///< a Lattice, or the straight lines
    bool separated = false, limits_held = true, airspace_held = true;  ///< as in Projected
    double lower_bound_m = 0.0;
    std::optional<Encounter> closest;  ///< of the motion; time_s is the share of the act
    /// Who took whose target; empty: everyone kept their own.
    std::vector<std::uint32_t> target_of;
    int rounds = 0;                  ///< of all projections together
    std::vector<std::string> rungs;  ///< what was done, in order; empty: the motion was separated as it came
};

/// Separates a motion, one means after the other until one works (DESIGN.md 8): as it is; projection; longer steps (1.5
/// and 2 times: limits give way to separation); finer rows and a wider filter; swapped targets among drones that are
/// stuck; straight lines. What none of these separates comes back as the best found (largest lower bound) with
/// `separated` false, and `closest` names pair, time and distance.
/// A result that is separated but needs more time than the limits' step allows is taken where may_stretch; otherwise
/// the next rung is tried for one that holds the limits too.
///
/// Properties: (1) ends exact, but for targets swapped (2) deterministic in the seed (3) target_of is a permutation.
///
/// Errors: those of raw and swapped; stopped.
///
/// Cost: each rung ends at most_work and max_rounds (longer steps get a quarter of the work, tries after a swap half),
/// so hopeless inputs end: 20,000 drones after about 45 s of CPU.
Result<Separation> separate(const LadderTask& task, const Run& run);

}  // namespace aerogram::planner
