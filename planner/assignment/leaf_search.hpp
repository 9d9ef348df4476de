#pragma once
#include <cstdint>
#include <span>

#include "planner/assignment/price_leaves.hpp"

namespace aerogram::planner {

/// Bounds tested at a time.
inline constexpr std::size_t kSearchLanes = 8;

/// What one bidder may not take: places, ascending, and those beyond the reach (see Allowed).
struct BidderLimits {
    std::span<const std::uint32_t> forbidden;
    double reach2_m2, downwash;
};

/// Improves the offer by looking at the leaf `first`, then at every leaf whose bound is above the second-best value.
/// @param rounding  how far a bound may fall short of a value it bounds.
void search(const PriceLeaves::Tables& tables, const Vec3& x, double rounding, std::size_t first,
            PriceLeaves::Offer& offer);
void search_allowed(const PriceLeaves::Tables& tables, const Vec3& x, double rounding, std::size_t first,
                    const BidderLimits& limits, PriceLeaves::Offer& offer);

}  // namespace aerogram::planner
