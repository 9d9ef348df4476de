#pragma once
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "geo/run.hpp"
#include "planner/assignment/allowed.hpp"
#include "planner/assignment/coordinates.hpp"

namespace aerogram::planner {

inline constexpr std::uint32_t kUnmatched = std::numeric_limits<std::uint32_t>::max();

/// As many bidders with an allowed target each as possible.
struct MaximumMatching {
    std::vector<std::uint32_t> target_of;  ///< kUnmatched where none
    /// When not all are matched, why: these bidders may take these targets only, one fewer (Hall's condition).
    /// Ascending.
    std::vector<std::uint32_t> stuck_bidders, their_targets;

    [[nodiscard]] bool is_complete() const { return stuck_bidders.empty(); }
};

/// @param start  a matching to begin with, of which the allowed pairs are kept; empty: none.
/// @returns nothing when stopped.
/// Cost: searches by depth in which each target is reached once, found in the leaves of a kd tree; O(n) memory.
/// Source: Hopcroft and Karp 1973, without their layers; Efrat, Itai and Katz 2001 for the deletion of points.
std::optional<MaximumMatching> maximum_matching(const Coordinates& bidders, const Coordinates& targets,
                                                const Allowed& allowed, const std::vector<std::uint32_t>& start,
                                                const Run& run);

}  // namespace aerogram::planner
