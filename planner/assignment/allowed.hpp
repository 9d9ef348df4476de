#pragma once
#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "planner/assignment/coordinates.hpp"

namespace aerogram::planner {

/// Which bidders may take which targets: not the forbidden ones, and none farther away than the reach.
struct Allowed {
    std::vector<std::vector<std::uint32_t>> forbidden;  ///< by bidder: targets, ascending; empty: none for anybody
    double reach2_m2 = std::numeric_limits<double>::infinity();  ///< squared length of the longest flight
    double downwash = 1.0;  ///< flights are true metres; coordinates are in the separation metric

    [[nodiscard]] bool everything() const {
        return forbidden.empty() && reach2_m2 == std::numeric_limits<double>::infinity();
    }
    [[nodiscard]] std::span<const std::uint32_t> forbidden_to(std::size_t bidder) const {
        return forbidden.empty() ? std::span<const std::uint32_t>{} : forbidden[bidder];
    }
    /// The squared true distance; every place that asks gets the same bits.
    [[nodiscard]] double distance2_m2(const Vec3& x, const Vec3& y) const {
        const double dx = x.x - y.x, dy = x.y - y.y, dz = (x.z - y.z) * downwash;
        return dx * dx + dy * dy + dz * dz;
    }
    [[nodiscard]] bool operator()(const Coordinates& bidders, const Coordinates& targets, std::size_t bidder,
                                  std::uint32_t target) const {
        const auto row = forbidden_to(bidder);
        return !std::binary_search(row.begin(), row.end(), target) &&
               distance2_m2(bidders[bidder], targets[target]) <= reach2_m2;
    }
};

}  // namespace aerogram::planner
