#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "planner/assignment/allowed.hpp"
#include "planner/assignment/coordinates.hpp"
#include "planner/assignment/kd_order.hpp"

namespace aerogram::planner {

/// Priced targets in the leaves of a kd tree, searched for the two best values 2 x·y - price without looking at all of
/// them. Each leaf keeps a linear fit c + g·y of its prices and the least residual r over it, so that nothing in its
/// box (centre m, half size h) is worth more than (2x - g)·m + |2x - g|·h - c - r. Prices may only rise: a stale fit
/// stays a bound. Bounds are in single precision, eight at a time, with room for its rounding; values are in double.
/// Targets are named by their place in kd order; index_at() gives back the caller's.
class PriceLeaves {
  public:
    struct Offer {
        std::uint32_t place = 0;           ///< of the best target; among equals by the order of the search
        double value = 0.0, second = 0.0;  ///< minus infinity where nothing is allowed
    };

    /// @param targets  n >= 2. @param price  by target; empty: |y|², so that the nearest target is the best.
    /// @param weight  how much each axis counts in the shape of the leaves: see weights_by_spread of the bidders.
    explicit PriceLeaves(const Coordinates& targets, std::span<const double> price = {},
                         const Vec3& weight = {1.0, 1.0, 1.0});

    /// The best target for a bidder at x, and the second-best value. @param start  a place worth looking at first.
    [[nodiscard]] Offer best(const Vec3& x, std::uint32_t start) const;
    /// The same among the targets allowed to the bidder.
    [[nodiscard]] Offer best(const Vec3& x, std::uint32_t start, std::uint32_t bidder, const Allowed& allowed) const;
    void raise(std::uint32_t place, double price);
    [[nodiscard]] double price(std::uint32_t place) const { return tables_.price[place]; }
    [[nodiscard]] std::uint32_t index_at(std::uint32_t place) const { return order_[place]; }
    [[nodiscard]] std::uint32_t place_of(std::uint32_t index) const { return place_[index]; }

    static constexpr std::uint32_t kLeafSize = 64;

    /// What the search reads: by place, the last leaf filled up with targets of infinite price; by leaf the bounds'
    /// m, h, g and g·m + c + r, filled up to blocks of eight with leaves worth nothing.
    struct Tables {
        Coordinates at;
        std::vector<double> price;
        std::vector<float> mx, my, mz, hx, hy, hz, gx, gy, gz, offset;
    };

  private:
    void fit(std::size_t leaf);
    [[nodiscard]] double rounding(const Vec3& x) const;

    std::vector<std::uint32_t> order_, place_;
    Tables tables_;
    std::vector<std::uint32_t> changes_;  ///< by leaf: price changes since the last fit
    double reach_ = 0.0;                  ///< the largest |m| + |h|
    double scale_ = 0.0;                  ///< the largest |g·m + c + r| + |g|·(|m| + |h|) so far
};

}  // namespace aerogram::planner
