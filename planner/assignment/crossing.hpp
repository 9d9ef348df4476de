#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "geo/ids.hpp"
#include "geo/run.hpp"
#include "planner/assignment/coordinates.hpp"
#include "planner/assignment/kd_order.hpp"

namespace aerogram::planner {

/// Straight flights as pairs see them: products (a_i - a_j)·(b_i - b_j) in the separation metric. Flights stand in an
/// order of places, neighbours together, in blocks whose boxes tell that most pairs of blocks need no look.
class Flights {
  public:
    static constexpr std::size_t kBlock = 32;

    Flights(std::span<const Vec3> from_m, std::span<const Vec3> to_m, std::span<const SlotId> slot_of,
            const SeparationMetric& metric);

    [[nodiscard]] std::size_t size() const { return order_.size(); }
    [[nodiscard]] std::size_t blocks() const { return box_.size(); }
    [[nodiscard]] std::size_t drone_at(std::size_t place) const { return order_[place]; }
    /// kCrossingTolerance times the product of the two formations' sizes.
    [[nodiscard]] double tolerance_m2() const { return tolerance_m2_; }

    /// False only when no product of a drone of block a with one of block b is below the limit.
    [[nodiscard]] bool may_be_below(std::size_t a, std::size_t b, double limit_m2) const;
    /// The first place q in [begin, end) whose product with place p is below the limit; `end` when there is none.
    [[nodiscard]] std::size_t first_below(std::size_t p, std::size_t begin, std::size_t end, double limit_m2) const;
    [[nodiscard]] double product_m2(std::size_t p, std::size_t q) const;
    /// The two change targets; box_again() of their blocks is due before may_be_below() is asked.
    void swap_targets(std::size_t p, std::size_t q);
    void box_again(std::size_t block);

  private:
    struct Boxes {
        Box from, to;
    };
    std::vector<std::uint32_t> order_;  ///< drone by place
    Coordinates from_, to_;             ///< by place
    std::vector<Boxes> box_;            ///< by block
    double tolerance_m2_ = 0.0;
};

/// Pairs cross when their product is below minus this share of the product of the formations' sizes (largest extents):
/// a thousand times the rounding of the product, and far below what moves s/√2 by a micrometre. Swapping such a pair
/// lowers the squared cost by at least twice that, so swapping ends.
inline constexpr double kCrossingTolerance = 1e-12;

/// Whether two drones (indices) may change slots.
using MaySwap = std::function<bool(std::size_t, std::size_t)>;

/// Swaps the slots of crossing pairs until none is left that may, and puts pairs whose swap costs nothing (|product|
/// within the tolerance) in index order while that keeps it so. False when stopped.
bool uncross(std::span<const Vec3> from_m, std::span<const Vec3> to_m, std::vector<SlotId>& slot_of,
             const SeparationMetric& metric, const Run& run, const MaySwap& may_swap = {});

}  // namespace aerogram::planner
