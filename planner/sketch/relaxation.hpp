#pragma once
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "geo/vec3.hpp"

namespace aerogram::planner {

/// The parameters of paper 002, algorithm 1. Its points are the fixed ones (bPoints) and the others (iPoints).
struct GaussianRelaxation {
    std::size_t rounds = 60;
    double beta = 3.0;                                   ///< Gaussian constant, > 0, in units of 1 / spacing²
    double speed = 8.0;                                  ///< moving rate, > 0
    std::span<const double> weights = {};                ///< w, one >= 0 a point, or empty: 1
    std::function<double(const Vec2&)> spacing_at = {};  ///< > 0: how far neighbours are to be apart; empty: spacing
    double spacing = 1.0;                                ///< > 0
    std::function<bool(const Vec2&)> inside = {};        ///< where points may be; empty: anywhere
};

/// Spreads points evenly: round by round each moves by speed * w * the mean over its neighbours of d exp(-beta d²), d
/// the way from the neighbour. Neighbours are those within 2.5 spacings, registered in a grid each round (section 3.5).
/// @param points  at least one. @param fixed  the first ones stay.
/// Properties: (1) the fixed stay (2) a point that is inside stays inside (3) deterministic. Cost: O(points) a round,
/// fewer rounds where nobody moves any more. Where we differ: neighbours' pushes are multiplied by their weights, too,
/// as the text wants heavy agents to push the others away, which as printed w does not do; where a density is asked
/// for, beta follows the local spacing; a step is a quarter spacing at most, and one that would leave the inside is
/// halved twice, else not made.
[[nodiscard]] std::vector<Vec2> relaxed(std::vector<Vec2> points, std::size_t fixed, const GaussianRelaxation& how);

}  // namespace aerogram::planner
