#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "geo/run.hpp"
#include "planner/assignment/coordinates.hpp"

namespace aerogram::planner {

/// Who takes which target, and a price per target that proves how good that is (the dual of the assignment problem):
/// no matching has Σ 2 x_i·y_σ(i) above this one's by more than Σ_i (max_j (2 x_i·y_j - price_j) - (2 x_i·y_σ(i) -
/// price_σ(i))).
struct Matching {
    std::vector<std::uint32_t> target_of;
    std::vector<double> price;
};

/// How far values 2 x·y - |y|² may lie apart, m².
double value_range_m2(const Coordinates& bidders, const Coordinates& targets);

/// Nearly maximises Σ 2 x_i·y_σ(i), that is, minimises Σ |x_i - y_σ(i)|²: ε-scaling Gauss-Seidel auction on pruned
/// leaves, no cost matrix. @returns nothing when stopped.
/// @param bidders, targets  n >= 2 each, about their barycentres.
/// @param last_epsilon  above 1e-15 of the value range, below which rounding would swallow the bids.
/// Accuracy and cost: the gap is at most n·last_epsilon; O(n) memory. Source: Bertsekas 1988; the leaf bounds are ours.
std::optional<Matching> auction(const Coordinates& bidders, const Coordinates& targets, double last_epsilon,
                                const Run& run);

/// The exact optimum from any start: keeps the pairs that the start's prices justify and joins the rest by shortest
/// augmenting paths, costs computed as needed. @returns nothing when stopped.
/// @param start  empty vectors: from scratch.
/// Accuracy and cost: the gap is rounding (about 1e-16 of the squared size a pair); O(n³) at worst, O(n) memory.
/// Source: Jonker and Volgenant 1987.
std::optional<Matching> augment(const Coordinates& bidders, const Coordinates& targets, Matching start, const Run& run);

/// The certified bound of Matching: how far Σ |x_i - y_σ(i)|² may be above the smallest possible, m².
double duality_gap_m2(const Coordinates& bidders, const Coordinates& targets, const Matching& matching);

}  // namespace aerogram::planner
