#pragma once
#include <map>
#include <optional>
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
    bool pairwise = false;                 ///< no pair crosses (all pairs checked): straight flights keep s/sqrt(2)
    std::optional<CrossingPair> crossing;  ///< a witness when not pairwise
};

/// Minimises the sum of squared distances (separation metric); exact, then pairs are swapped until no pair violates
/// (a_i - a_j)·(b_i - b_j) >= 0 (DESIGN.md 6). Pairs whose swap costs nothing end in index order.
/// Properties: (1) a bijection (2) duality_gap <= 1e-12 up to 3,000 drones (auction, closed by augmenting paths),
/// typically 1e-12 to 1e-9 above (auction alone) (3) pairwise unless pins cross (4) same input, same result.
/// Cost: 1,000 drones 0.03-0.1 s, O(n) memory. Reports stage "assign".
/// @param from_m, to_m  n drones and n slots, finite.
/// @param pins  drones whose slot is the designer's; never moved, only reported.
/// Errors: stopped.
Result<Assignment> assign_shortest(std::span<const Vec3> from_m, std::span<const Vec3> to_m,
                                   const std::map<DroneId, SlotId>& pins, const SeparationMetric& metric,
                                   const Run& run);

/// Drone i flies to slot i, pins first: displaced drones take the slots that pins vacated, in index order.
Assignment assign_keep(std::span<const Vec3> from_m, std::span<const Vec3> to_m, const std::map<DroneId, SlotId>& pins,
                       const SeparationMetric& metric);

/// Sets of drones and sets of slots of equal size, matched to each other.
struct GroupMatch {
    std::vector<std::vector<DroneId>> drones;  ///< disjoint, together all drones
    std::vector<std::vector<SlotId>> slots;    ///< disjoint, together all slots
    /// slots set that a drone set must take (by name in the mission), or absent: matched by barycentre among equal
    /// sizes.
    std::vector<std::optional<std::size_t>> wanted;
};
/// Whole groups to whole slot sets (at the least sum of squared barycentre distances within a size), then shortest
/// inside each. A pin takes its whole group to its slot's set. The gap is that of the matches inside the sets.
/// Errors: infeasible when sizes admit no matching or a pin leaves its group (message says which); stopped.
Result<Assignment> assign_groups(std::span<const Vec3> from_m, std::span<const Vec3> to_m, const GroupMatch& groups,
                                 const std::map<DroneId, SlotId>& pins, const SeparationMetric& metric, const Run& run);

/// First (lowest indices) pair that crosses, by an all-pairs check; absent: the pairwise property holds.
[[nodiscard]] std::optional<CrossingPair> find_crossing(std::span<const Vec3> from_m, std::span<const Vec3> to_m,
                                                        std::span<const SlotId> slot_of,
                                                        const SeparationMetric& metric);

}  // namespace aerogram::planner
