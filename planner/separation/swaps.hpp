#pragma once
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "geo/vec3.hpp"

namespace aerogram::planner {

/// Swaps the targets of drones that are stuck with each other: within each cluster of stuck pairs, pairs whose straight
/// ways cross, (a_i - a_j)·(b_i - b_j) < 0 in the metric, change targets until none is left. Each swap shortens the sum
/// of squared ways, so it ends.
/// @param from_m, to_m  by drone, before any swap.  @param target_of  drone -> whose target; changed in place.
/// @returns how many pairs were swapped.
std::size_t swap_stuck(std::span<const Vec3> from_m, std::span<const Vec3> to_m,
                       std::span<const std::pair<std::uint32_t, std::uint32_t>> stuck, const SeparationMetric& metric,
                       std::vector<std::uint32_t>& target_of);

}  // namespace aerogram::planner
