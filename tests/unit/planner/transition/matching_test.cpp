#include "planner/transition/matching.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "planner/transition/hungarian.hpp"
#include "planner/transition/max_min.hpp"
#include "tests/unit/planner/transition/shapes.hpp"

namespace aerogram::planner {
namespace {

using namespace testing;

std::int64_t score_of(const std::vector<std::int64_t>& scores, const std::vector<std::size_t>& match) {
    std::int64_t sum = 0;
    for (std::size_t k = 0; k < match.size(); ++k) sum += scores[k * match.size() + match[k]];
    return sum;
}

TEST(Hungarian, FindsTheBestOfAllPermutations) {
    const int count = tries(200);
    for (int seed = 1; seed <= count; ++seed) {
        SCOPED_TRACE(seed);
        Random random(static_cast<std::uint64_t>(seed));
        const std::size_t n = 1 + random.below(7);
        std::vector<std::int64_t> scores(n * n);
        for (auto& s : scores)
            s = static_cast<std::int64_t>(random.below(seed % 2 == 0 ? 4 : 1000));  // with and without ties
        std::vector<std::size_t> order(n);
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::int64_t best = -1;
        do best = std::max(best, score_of(scores, order));
        while (std::next_permutation(order.begin(), order.end()));
        EXPECT_EQ(score_of(scores, best_matching(scores, n)), best);
    }
}

TEST(Hungarian, NothingToMatchIsFine) {
    EXPECT_TRUE(best_matching({}, 0).empty());
}

TEST(MaxMin, FindsTheLargestSmallestScoreAndThenTheLargestSumOfAllPermutations) {
    const int count = tries(300);
    for (int seed = 1; seed <= count; ++seed) {
        SCOPED_TRACE(seed);
        Random random(static_cast<std::uint64_t>(seed));
        const std::size_t n = random.below(8);
        std::vector<std::int64_t> scores(n * n);
        for (auto& s : scores)
            s = static_cast<std::int64_t>(random.below(seed % 2 == 0 ? 5 : std::uint64_t{1} << 30));  // ties or none
        std::vector<std::size_t> order(n);
        std::iota(order.begin(), order.end(), std::size_t{0});
        const auto smallest = [&](const std::vector<std::size_t>& match) {
            std::int64_t least = std::int64_t{1} << 40;
            for (std::size_t k = 0; k < n; ++k) least = std::min(least, scores[k * n + match[k]]);
            return least;
        };
        std::pair<std::int64_t, std::int64_t> best{-1, -1};
        do best = std::max(best, std::pair(smallest(order), score_of(scores, order)));
        while (std::next_permutation(order.begin(), order.end()));
        const std::vector<std::size_t> found = max_min_matching(scores, n);
        EXPECT_EQ(std::pair(smallest(found), score_of(scores, found)), best);
    }
}

TEST(MatchedBases, MaxMinNeverHasASmallerSmallestProductThanGreedy) {
    const int count = tries(30);
    int better = 0;
    for (int seed = 1; seed <= count; ++seed) {
        SCOPED_TRACE(seed);
        Random random(static_cast<std::uint64_t>(seed));
        const std::size_t n = 5 + random.below(25);
        const Eigenbasis source = laplacian_eigenbasis(full_graph(random_points(random, n)));
        const Eigenbasis target = laplacian_eigenbasis(full_graph(random_points(random, n)));
        const auto smallest = [&](Reorder r) {
            const dense::Matrix turn = matched_bases(source.modes, source.spaces, target, r).turn;
            double least = 1.0;
            for (std::size_t k = 0; k < turn.columns; ++k) least = std::min(least, std::abs(turn(k, k)));
            return least;
        };
        const double greedy = smallest(Reorder::greedy), max_min = smallest(Reorder::max_min);
        EXPECT_GE(max_min, greedy - 1e-8);
        better += max_min > greedy + 1e-3 ? 1 : 0;
    }
    EXPECT_GT(better, count / 2);
}

double diagonal_sum(const dense::Matrix& turn) {
    double sum = 0.0;
    for (std::size_t k = 0; k < turn.columns; ++k) sum += std::abs(turn(k, k));
    return sum;
}

void expect_proper(const MatchedBases& bases) {
    const std::size_t n = bases.turn.columns;
    EXPECT_LT(largest_difference(bases.turn, times(transposed(bases.source), bases.target)), 1e-13);
    EXPECT_LT(largest_difference(times(transposed(bases.turn), bases.turn), identity(n)), 1e-12);
    EXPECT_EQ(dense::determinant_sign(bases.turn), 1.0);
    std::size_t negative = 0, weakest = 0;
    for (std::size_t k = 0; k < n; ++k) {
        if (bases.turn(k, k) < -1e-9) ++negative;
        if (std::abs(bases.turn(k, k)) < std::abs(bases.turn(weakest, weakest))) weakest = k;
    }
    EXPECT_LE(negative, 1U);
    if (negative == 1) {
        EXPECT_LT(bases.turn(weakest, weakest), 0.0);
    }
}

TEST(MatchedBases, Property2DeterminantIsOneAndOnlyTheWeakestColumnIsFlipped) {
    const int count = tries(60);
    int flips = 0;
    for (int seed = 1; seed <= count; ++seed) {
        SCOPED_TRACE(seed);
        Random random(static_cast<std::uint64_t>(seed));
        const std::size_t n = 1 + random.below(25);
        const Eigenbasis source = laplacian_eigenbasis(nearest_graph(random_points(random, n), 3));
        const Eigenbasis target = laplacian_eigenbasis(nearest_graph(random_points(random, n), 3));
        for (const Reorder reorder : {Reorder::none, Reorder::greedy, Reorder::max_min, Reorder::optimal}) {
            const MatchedBases bases = matched_bases(source.modes, source.spaces, target, reorder);
            expect_proper(bases);
            for (std::size_t k = 0; k + 1 < n; ++k) flips += bases.turn(k, k) < -1e-9 ? 1 : 0;
        }
    }
    EXPECT_GT(flips, count / 4) << "the determinant rule was hardly tried";
}

TEST(MatchedBases, Property3EqualGraphsTurnNothingEvenWithRepeatedEigenvalues) {
    for (const AdjacencyGraph& graph :
         {cycle_graph(12), complete_graph(6), AdjacencyGraph{6, {{0, 1, 1.0}, {2, 3, 1.0}}},
          nearest_graph(letter_h(20), 4), nearest_graph(ring(10, 5.0), 2)}) {
        const Eigenbasis source = laplacian_eigenbasis(graph);
        // The target's eigenspaces arrive turned, as another solver might give them.
        Eigenbasis target = source;
        Random random(31);
        for (const Eigenspace& s : target.spaces) {
            set_column_block(target.modes, s.first,
                             times(column_block(target.modes, s.first, s.last), random_basis(random, s.dimension())));
        }
        for (const Reorder reorder : {Reorder::none, Reorder::greedy, Reorder::max_min, Reorder::optimal}) {
            const MatchedBases bases = matched_bases(source.modes, source.spaces, target, reorder);
            EXPECT_LT(largest_difference(bases.turn, identity(graph.n - 1)), 1e-10);
        }
    }
}

TEST(MatchedBases, Property1TargetColumnsStayInTheirEigenspaces) {
    Random random(32);
    const Eigenbasis source = laplacian_eigenbasis(nearest_graph(random_points(random, 12), 4));
    const Eigenbasis target = laplacian_eigenbasis(cycle_graph(12));
    const MatchedBases bases = matched_bases(source.modes, source.spaces, target, Reorder::optimal);
    const dense::Matrix products = times(transposed(target.modes), bases.target);
    for (std::size_t k = 0; k < products.columns; ++k) {
        double largest = 0.0;
        for (const Eigenspace& s : target.spaces) {
            double inside = 0.0;
            for (std::size_t j = s.first; j < s.last; ++j) inside += products(j, k) * products(j, k);
            largest = std::max(largest, inside);
        }
        EXPECT_NEAR(largest, 1.0, 1e-12);
    }
}

TEST(MatchedBases, OptimalIsNeverBelowGreedyNorGreedyBelowSourceOrderInItsFirstChoice) {
    const int count = tries(30);
    for (int seed = 1; seed <= count; ++seed) {
        SCOPED_TRACE(seed);
        Random random(static_cast<std::uint64_t>(seed));
        const std::size_t n = 5 + random.below(25);
        const Eigenbasis source = laplacian_eigenbasis(full_graph(random_points(random, n)));
        const Eigenbasis target = laplacian_eigenbasis(full_graph(random_points(random, n)));
        const auto turn = [&](Reorder r) { return matched_bases(source.modes, source.spaces, target, r).turn; };
        const dense::Matrix greedy = turn(Reorder::greedy), optimal = turn(Reorder::optimal),
                            none = turn(Reorder::none);
        EXPECT_GE(diagonal_sum(optimal), diagonal_sum(greedy) - 1e-6);
        EXPECT_GE(diagonal_sum(optimal), diagonal_sum(none) - 1e-6);
        EXPECT_GE(std::abs(greedy(0, 0)), std::abs(none(0, 0)) - 1e-6);
    }
}

TEST(MatchedBases, GivenSourceIsKeptInAChain) {
    Random random(33);
    const Eigenbasis source = laplacian_eigenbasis(cycle_graph(8));
    const Eigenbasis target = laplacian_eigenbasis(full_graph(random_points(random, 8)));
    const MatchedBases kept = matched_bases(source.modes, {}, target, Reorder::optimal);
    EXPECT_EQ(kept.source.values, source.modes.values);
    expect_proper(kept);
    // A free source turns inside its pairs of equal eigenvalues and so comes closer.
    const MatchedBases moved = matched_bases(source.modes, source.spaces, target, Reorder::optimal);
    EXPECT_GT(diagonal_sum(moved.turn), diagonal_sum(kept.turn));
}

}  // namespace
}  // namespace aerogram::planner
