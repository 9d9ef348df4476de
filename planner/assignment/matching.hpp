#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "geo/run.hpp"
#include "planner/assignment/allowed.hpp"
#include "planner/assignment/coordinates.hpp"

namespace aerogram::planner {

/// Who takes which target, and a price per target that proves how good that is (the dual of the assignment problem):
/// no allowed matching has Σ 2 x_i·y_σ(i) above this one's by more than Σ_i (max_j (2 x_i·y_j - price_j) - (2
/// x_i·y_σ(i) - price_σ(i))), j over what i is allowed.
struct Matching {
    std::vector<std::uint32_t> target_of;
    std::vector<double> price;
};

/// How far values 2 x·y - |y|² may lie apart, m².
double value_range_m2(const Coordinates& bidders, const Coordinates& targets);

/// What gaps are given relative to, m²: the cost, or 1e-3 of the product of the formations' sizes a bidder where the
/// cost is smaller (below it a gap would show rounding alone).
double gap_scale_m2(const Coordinates& bidders, const Coordinates& targets, double cost_m2);

/// Σ |x_i - y_σ(i)|², m².
double cost_m2(const Coordinates& bidders, const Coordinates& targets, const std::vector<std::uint32_t>& target_of);

/// When an auction is over, whichever comes first.
struct AuctionEnd {
    double last_epsilon;  ///< bid step, m²; above 1e-15 of the value range, below which rounding would swallow bids
    double enough_gap = 0.0;  ///< certified gap relative to gap_scale_m2
};

/// Nearly maximises Σ 2 x_i·y_σ(i), that is, minimises Σ |x_i - y_σ(i)|²: ε-scaling Gauss-Seidel auction on pruned
/// leaves, no cost matrix. Large ones start from the prices of a coarse one, between cells of both sides.
/// @returns nothing when stopped.
/// @param bidders, targets  n >= 2 each, about their barycentres (or another common origin).
/// @param allowed  admits a matching of all.
/// Accuracy and cost: the gap is at most n·last_epsilon; O(n) memory. Source: Bertsekas 1988; the leaf bounds and the
/// coarse start are ours.
std::optional<Matching> auction(const Coordinates& bidders, const Coordinates& targets, const AuctionEnd& end,
                                const Run& run, const Allowed& allowed = {});

/// The exact optimum from any start: keeps the pairs that the start's prices justify and joins the rest by shortest
/// augmenting paths, costs computed as needed. @returns nothing when stopped.
/// @param start  empty vectors: from scratch. @param allowed  admits a matching of all.
/// Accuracy and cost: the gap is rounding (about 1e-16 of the squared size a pair); O(n³) at worst, O(n) memory.
/// Source: Jonker and Volgenant 1987.
std::optional<Matching> augment(const Coordinates& bidders, const Coordinates& targets, Matching start, const Run& run,
                                const Allowed& allowed = {});

/// The certified bound of Matching: how far Σ |x_i - y_σ(i)|² may be above the smallest allowed, m².
double duality_gap_m2(const Coordinates& bidders, const Coordinates& targets, const Matching& matching,
                      const Allowed& allowed = {});

}  // namespace aerogram::planner
