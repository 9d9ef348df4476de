#pragma once
#include <cstdint>
#include <optional>

#include "planner/motion/act.hpp"

namespace aerogram::planner {

/// The motion blown up where the whole fleet contracts to less room than it needs (everyone through one point, a sphere
/// flown inside out): each drone gets a seeded place in a ball of one tenth filling, as far as the row is too narrow.
/// Absent when there is no such row. The first and last three rows stay.
/// @param spacing_m  what drones need, in the metric.
[[nodiscard]] std::optional<Lattice> spread_waist(const Lattice& input, double spacing_m,
                                                  const SeparationMetric& metric, std::uint64_t seed);

}  // namespace aerogram::planner
