#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "geo/ids.hpp"
#include "geo/run.hpp"
#include "planner/assignment/coordinates.hpp"

namespace aerogram::planner {

/// Straight flights as pairs see them: (a_i - a_j)·(b_i - b_j) in the separation metric for all j at a time.
struct Flights {
    Coordinates from, to;       ///< by drone
    double tolerance_m2 = 0.0;  ///< kCrossingTolerance times the product of the two formations' sizes

    Flights(std::span<const Vec3> from_m, std::span<const Vec3> to_m, std::span<const SlotId> slot_of,
            const SeparationMetric& metric);
    /// The first j >= begin whose product with i is below limit_m2; the number of drones when there is none.
    [[nodiscard]] std::size_t first_below(std::size_t i, std::size_t begin, double limit_m2) const;
};

/// Pairs cross when their product is below minus this share of the product of the formations' sizes (largest extents):
/// a thousand times the rounding of the product, and far below what moves s/√2 by a micrometre. Swapping such a pair
/// lowers the squared cost by at least twice that, so swapping ends.
inline constexpr double kCrossingTolerance = 1e-12;

/// Swaps the slots of crossing pairs until none is left, then puts pairs whose swap costs nothing (|product| within the
/// tolerance) in index order while that keeps it so. False when stopped.
bool uncross(std::span<const Vec3> from_m, std::span<const Vec3> to_m, std::vector<SlotId>& slot_of,
             const SeparationMetric& metric, const Run& run);

}  // namespace aerogram::planner
