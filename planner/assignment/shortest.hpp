#pragma once
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "geo/ids.hpp"
#include "geo/run.hpp"
#include "planner/assignment/assignment.hpp"

namespace aerogram::planner {

/// Fills slot_of for the given drones with the given slots (as many), pins first, the rest at the least squared cost.
/// @returns the certified gap to the least squared cost, m²; nothing when stopped.
std::optional<double> match_shortest(std::span<const Vec3> from_m, std::span<const Vec3> to_m,
                                     std::span<const DroneId> drones, std::span<const SlotId> slots,
                                     const std::map<DroneId, SlotId>& pins, const SeparationMetric& metric,
                                     std::vector<SlotId>& slot_of, const Run& run);

/// The assignment with its cost, its gap and the result of the all-pairs check.
Assignment reported(std::span<const Vec3> from_m, std::span<const Vec3> to_m, std::vector<SlotId> slot_of,
                    double gap_m2, const SeparationMetric& metric);

/// The contract of every assign function: as many finite slots as finite drones, pins in range and to different slots.
void require_sound(std::span<const Vec3> from_m, std::span<const Vec3> to_m, const std::map<DroneId, SlotId>& pins);

}  // namespace aerogram::planner
