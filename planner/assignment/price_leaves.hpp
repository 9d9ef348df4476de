#pragma once
#include <cstdint>
#include <vector>

#include "planner/assignment/coordinates.hpp"

namespace aerogram::planner {

/// Priced targets in the leaves of a kd tree, searched for the two best values 2 x·y - price without looking at all of
/// them. Each leaf keeps a linear fit c + g·y of its prices and the least residual r over it, so that nothing in its
/// box (centre m, half size h) is worth more than (2x - g)·m + |2x - g|·h - c - r. Prices may only rise: a stale fit
/// stays a bound. Targets are named by their place in kd order; index_at() gives back the caller's.
class PriceLeaves {
  public:
    struct Offer {
        std::uint32_t place = 0;  ///< of the best target; ties are decided by the order of the search
        double value = 0.0, second = 0.0;
    };

    /// @param targets  n >= 2; each starts at the price |y|², so that the nearest target is the best.
    explicit PriceLeaves(const Coordinates& targets);

    /// The best target for a bidder at x, and the second-best value. @param start  a place worth looking at first.
    [[nodiscard]] Offer best(const Vec3& x, std::uint32_t start) const;
    void raise(std::uint32_t place, double price);
    [[nodiscard]] double price(std::uint32_t place) const { return price_[place]; }
    [[nodiscard]] std::uint32_t index_at(std::uint32_t place) const { return order_[place]; }

  private:
    struct Leaf {
        std::uint32_t begin = 0, end = 0;
        std::uint32_t changes = 0;  ///< price changes since the last fit
    };
    void split(const Coordinates& targets, std::uint32_t begin, std::uint32_t end);
    void fit(std::size_t leaf);
    void scan(std::size_t leaf, const Vec3& x, Offer& offer) const;

    std::vector<std::uint32_t> order_;
    Coordinates at_;
    std::vector<double> price_;
    std::vector<std::uint32_t> leaf_of_;
    std::vector<Leaf> leaves_;
    Coordinates center_, half_, slope_;
    std::vector<double> offset_;  ///< c + r per leaf
};

/// Indices in the order of a kd tree's leaves: near ones close together.
std::vector<std::uint32_t> kd_order(const Coordinates& points);

}  // namespace aerogram::planner
