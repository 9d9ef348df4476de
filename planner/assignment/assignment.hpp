#pragma once
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "geo/ids.hpp"
#include "geo/result.hpp"
#include "geo/run.hpp"
#include "geo/vec3.hpp"

namespace aerogram::planner {

/// A pair of drones whose straight flights may come closer than 1/sqrt(2) of the formations' spacing:
/// (a_i - a_j)·(b_i - b_j) < 0 in the separation metric, by more than 1e-12 of the product of the formations' sizes
/// (twice the largest distance from the barycentre), which is rounding and moves s/sqrt(2) by less than a micrometre.
struct CrossingPair {
    DroneId first, second;
};

/// Who flies where: slot_of[d] is drone d's slot; a bijection.
struct Assignment {
    std::vector<SlotId> slot_of;
    double cost_m2 = 0.0;  ///< sum of squared distances, separation metric
    /// Certified: (cost - dual bound) / max(cost, tiny), where tiny (1e-3 of the product of the formations' sizes a
    /// drone) keeps rounding from showing as a gap of flights next to nothing; 0 for designer's choices.
    double duality_gap = 0.0;
    double longest_m = 0.0;                ///< the longest flight, true metres
    bool longest_is_least = false;         ///< certified: every allowed matching has a flight at least as long
    bool pairwise = false;                 ///< no pair crosses (all pairs checked): straight flights keep s/sqrt(2)
    std::optional<CrossingPair> crossing;  ///< a witness when not pairwise
};

/// What the designer settled: pairs that must be, and pairs that may not be.
struct MatchRules {
    std::map<DroneId, SlotId> pins;  ///< to different slots
    std::set<std::pair<DroneId, SlotId>> forbid;

    MatchRules() = default;
    MatchRules(std::map<DroneId, SlotId> pinned,  // NOLINT(google-explicit-constructor)
               std::set<std::pair<DroneId, SlotId>> forbidden = {})
        : pins(std::move(pinned)), forbid(std::move(forbidden)) {}
};

/// Minimises the sum of squared distances (separation metric); then pairs are swapped until no pair violates
/// (a_i - a_j)·(b_i - b_j) >= 0 (DESIGN.md 6). Pairs whose swap costs nothing end in index order.
/// Properties: (1) a bijection that keeps the rules (2) duality_gap <= 1e-12 up to 3,000 drones (auction, closed by
/// augmenting paths), <= 1e-7 above (auction alone) (3) pairwise unless rules stand against it (4) same input, same
/// result.
/// Cost: 10,000 drones 0.15-0.5 s, O(n) memory. Reports stage "assign".
/// @param from_m, to_m  n drones and n slots, finite.
/// Errors: infeasible when the rules admit no matching (message names drones and the too few slots that they may
/// take); stopped.
Result<Assignment> assign_shortest(std::span<const Vec3> from_m, std::span<const Vec3> to_m, const MatchRules& rules,
                                   const SeparationMetric& metric, const Run& run);

/// Minimises the longest flight (true metres), then, among the matchings whose longest flight is that, the sum of
/// squared distances (separation metric). Crossing pairs change slots where that keeps the longest flight.
/// Properties: (1) a bijection that keeps the rules (2) longest_m is the least: a search found no matching with shorter
/// flights only (3) cost_m2 is within duality_gap (as in assign_shortest) of the least at that length (4) same input,
/// same result. Not pairwise in general: see `crossing`. A pinned flight longer than the rest needs sets the length.
/// Cost: 10,000 drones 3-14 s (pads under letters, whose drones are alike, take longest), O(n) memory. Reports stage
/// "assign". Errors: as assign_shortest.
Result<Assignment> assign_bottleneck(std::span<const Vec3> from_m, std::span<const Vec3> to_m, const MatchRules& rules,
                                     const SeparationMetric& metric, const Run& run);

/// Drone i flies to slot i, pins first: displaced drones take the slots that pins vacated, in index order.
/// Errors: infeasible when that uses a forbidden pair (message names it).
Result<Assignment> assign_keep(std::span<const Vec3> from_m, std::span<const Vec3> to_m, const MatchRules& rules,
                               const SeparationMetric& metric, const Run& run = {});

/// Sets inside a set, and sets inside those. Members of the outer set that are in none make one more set.
template <class Id>
struct Subsets {
    std::vector<std::vector<Id>> sets;  ///< disjoint
    std::vector<Subsets> inside;        ///< empty, or one per set
};

/// Sets of drones and sets of slots of equal size, matched to each other.
struct GroupMatch {
    std::vector<std::vector<DroneId>> drones;  ///< disjoint, together all drones
    std::vector<std::vector<SlotId>> slots;    ///< disjoint, together all slots
    /// slots set that a drone set must take (by name in the mission), or absent: matched by barycentre among equal
    /// sizes.
    std::vector<std::optional<std::size_t>> wanted;
    std::vector<Subsets<DroneId>> drones_inside = {};  ///< groups in groups: empty, or one per drone set
    std::vector<Subsets<SlotId>> slots_inside = {};    ///< empty, or one per slot set
};
/// Whole groups to whole slot sets (at the least sum of squared barycentre distances within a size), then the groups
/// inside each likewise, where both sides have some, then drones, shortest. A pin takes its whole group to its slot's
/// set. A group does not go where forbidden pairs leave it no matching. The gap is that of the matches inside the
/// innermost sets.
/// Errors: infeasible when sizes or rules admit no matching or a pin leaves its group (message says which); stopped.
Result<Assignment> assign_groups(std::span<const Vec3> from_m, std::span<const Vec3> to_m, const GroupMatch& groups,
                                 const MatchRules& rules, const SeparationMetric& metric, const Run& run);

/// First (lowest indices) pair that crosses, by an all-pairs check on run.threads threads (it is not stopped); absent:
/// the pairwise property holds.
[[nodiscard]] std::optional<CrossingPair> find_crossing(std::span<const Vec3> from_m, std::span<const Vec3> to_m,
                                                        std::span<const SlotId> slot_of, const SeparationMetric& metric,
                                                        const Run& run = {});

}  // namespace aerogram::planner
