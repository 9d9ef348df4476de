#pragma once
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "geo/ids.hpp"
#include "geo/run.hpp"
#include "planner/assignment/assignment.hpp"
#include "planner/assignment/maximum_matching.hpp"

namespace aerogram::planner {

/// Drones and slots that are free to match, without those of pins, as bidders and targets.
struct FreeMatch {
    std::vector<DroneId> drones;  ///< ascending; bidder k is drones[k]
    std::vector<SlotId> slots;
    Coordinates x, y;  ///< in the separation metric, each about its barycentre
    Allowed allowed;
};

/// The free part of the given drones and slots (as many), and slot_of filled for the pinned ones.
/// Errors: infeasible when a pin is forbidden.
Result<FreeMatch> free_match(std::span<const Vec3> from_m, std::span<const Vec3> to_m, std::span<const DroneId> drones,
                             std::span<const SlotId> slots, const MatchRules& rules, const SeparationMetric& metric,
                             std::vector<SlotId>& slot_of);

/// The bidders' least squared cost under what is allowed, crossings swapped away where allowed. Fills slot_of.
/// @param start  a complete allowed matching, or empty where everything is allowed.
/// @returns the certified gap, m². Errors: stopped.
Result<double> solve_shortest(const FreeMatch& match, std::vector<SlotId>& slot_of, const Run& run);

/// Fills slot_of for the given drones with the given slots (as many), pins first, the rest at the least squared cost.
/// @returns the certified gap to the least squared cost, m². Errors: infeasible by the rules; stopped.
Result<double> match_shortest(std::span<const Vec3> from_m, std::span<const Vec3> to_m, std::span<const DroneId> drones,
                              std::span<const SlotId> slots, const MatchRules& rules, const SeparationMetric& metric,
                              std::vector<SlotId>& slot_of, const Run& run);

/// A complete allowed matching. Errors: infeasible, naming drones that may take too few slots; stopped.
Result<MaximumMatching> any_matching(const FreeMatch& match, const Run& run);

/// The assignment with its cost, its gap and the result of the all-pairs check.
Assignment reported(std::span<const Vec3> from_m, std::span<const Vec3> to_m, std::vector<SlotId> slot_of,
                    double gap_m2, const SeparationMetric& metric, const Run& run);

/// The contract of every assign function: as many finite slots as finite drones, rules in range, pins to different
/// slots.
void require_sound(std::span<const Vec3> from_m, std::span<const Vec3> to_m, const MatchRules& rules);

/// All ids below n.
template <class Id>
std::vector<Id> first_ids(std::size_t n) {
    std::vector<Id> ids;
    for (std::size_t i = 0; i < n; ++i) ids.emplace_back(i);
    return ids;
}

}  // namespace aerogram::planner
