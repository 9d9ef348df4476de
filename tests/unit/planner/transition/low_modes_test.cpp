#include "planner/transition/low_modes.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "planner/transition/lanczos.hpp"
#include "planner/transition/sparse.hpp"
#include "planner/transition/subspace_turn.hpp"
#include "tests/unit/planner/transition/shapes.hpp"

namespace aerogram::planner {
namespace {

using namespace testing;
const ::aerogram::Run kRun{};

/// A grid graph of unit weights: eigenvalues 2 - 2 cos(pi a / w) + 2 - 2 cos(pi b / h).
AdjacencyGraph grid_graph(std::uint32_t w, std::uint32_t h) {
    AdjacencyGraph g{std::size_t{w} * h, {}};
    for (std::uint32_t y = 0; y < h; ++y) {
        for (std::uint32_t x = 0; x < w; ++x) {
            if (x + 1 < w) g.edges.push_back({y * w + x, y * w + x + 1, 1.0});
            if (y + 1 < h) g.edges.push_back({y * w + x, (y + 1) * w + x, 1.0});
        }
    }
    return g;
}

std::vector<double> grid_values(std::uint32_t w, std::uint32_t h) {
    std::vector<double> out;
    for (std::uint32_t a = 0; a < w; ++a) {
        for (std::uint32_t b = 0; b < h; ++b) {
            out.push_back(4.0 - 2.0 * std::cos(std::numbers::pi * a / w) - 2.0 * std::cos(std::numbers::pi * b / h));
        }
    }
    std::ranges::sort(out);
    out.erase(out.begin());
    return out;
}

double residual(const AdjacencyGraph& g, const Eigenbasis& basis) {
    double worst = 0.0;
    for (std::size_t k = 0; k < basis.values.size(); ++k) {
        const auto x = basis.modes.column(k);
        std::vector<double> y(g.n);
        for (std::size_t i = 0; i < g.n; ++i) y[i] = -basis.values[k] * x[i];
        for (const Edge& e : g.edges) {
            y[e.a] += e.weight * (x[e.a] - x[e.b]);
            y[e.b] += e.weight * (x[e.b] - x[e.a]);
        }
        for (const double v : y) worst = std::max(worst, std::abs(v));
    }
    return worst;
}

void expect_orthonormal(const dense::Matrix& modes) {
    const dense::Matrix gram = dense::product(modes, dense::Op::transposed, modes);
    EXPECT_LT(largest_difference(gram, identity(modes.columns)), 1e-12);
    for (std::size_t k = 0; k < modes.columns; ++k) {
        EXPECT_NEAR(std::accumulate(modes.column(k).begin(), modes.column(k).end(), 0.0), 0.0, 1e-12);
    }
}

TEST(LowModes, Property1And2LanczosFindsTheClosedFormOfGridsWithTheirRepeatedValues) {
    for (const auto& [w, h] : {std::pair{40U, 40U}, std::pair{60U, 25U}}) {
        const AdjacencyGraph g = grid_graph(w, h);
        ASSERT_GT(g.n, kDenseComponent);
        const auto low = low_eigenbasis(g, 40, kRun);
        ASSERT_TRUE(low.ok());
        const std::vector<double> expected = grid_values(w, h);
        ASSERT_GE(low->values.size(), 40U);
        for (std::size_t k = 0; k < low->values.size(); ++k) EXPECT_NEAR(low->values[k], expected[k], 1e-9);
        EXPECT_GT(expected[low->values.size()] - low->values.back(), 1e-6) << "an eigenspace was cut";
        EXPECT_LT(residual(g, *low), 1e-8);
        expect_orthonormal(low->modes);
    }
}

TEST(LowModes, Property1LanczosAgreesWithTheDenseSolver) {
    Random random(51);
    const Points points = random_points(random, 700, 30.0);
    const AdjacencyGraph g = delaunay_adjacency(points);
    const auto low = low_eigenbasis(g, 20, kRun);
    ASSERT_TRUE(low.ok());
    const Eigenbasis all = laplacian_eigenbasis(g);
    for (std::size_t k = 0; k < low->values.size(); ++k) {
        EXPECT_NEAR(low->values[k], all.values[k], 1e-9 * all.values.back());
    }
    for (const Eigenspace& s : low->spaces) {
        const dense::Matrix overlap = dense::product(column_block(low->modes, s.first, s.last), dense::Op::transposed,
                                                     column_block(all.modes, s.first, s.last));
        const dense::SingularValues cosines = dense::singular_values(overlap);
        EXPECT_GT(cosines.values.back(), 1.0 - 1e-11);
    }
}

TEST(LowModes, Property3HigherMultiplicityThanTheBlockIsCountedAndFound) {
    // 12 equal arms of 60 round a hub: every mode that vanishes at the hub comes 11 times.
    AdjacencyGraph g{721, {}};
    for (std::uint32_t arm = 0; arm < 12; ++arm) {
        for (std::uint32_t i = 0; i < 60; ++i) {
            const std::uint32_t here = 1 + arm * 60 + i;
            g.edges.push_back({i == 0 ? 0 : here - 1, here, 1.0});
        }
    }
    std::ranges::sort(g.edges, {}, [](const Edge& e) { return std::pair(e.a, e.b); });
    const auto low = lanczos_low_modes(g, 20, 1e-6, kRun);
    ASSERT_TRUE(low.ok());
    const Eigenbasis all = laplacian_eigenbasis(g);
    ASSERT_GE(low->values.size(), 20U);
    for (std::size_t k = 0; k < low->values.size(); ++k) EXPECT_NEAR(low->values[k], all.values[k], 1e-9);
    EXPECT_GT(all.values[low->values.size()] - low->values.back(), 1e-6);
}

TEST(LowModes, Property3AndComponentsAreTakenForThemselves) {
    // Five equal grids apart: the kernel has four modes here and every other value comes five times.
    AdjacencyGraph g{0, {}};
    for (int copy = 0; copy < 5; ++copy) {
        const AdjacencyGraph one = grid_graph(9, 8);
        for (Edge e : one.edges) {
            const auto shift = static_cast<std::uint32_t>(g.n);
            g.edges.push_back({e.a + shift, e.b + shift, e.weight});
        }
        g.n += one.n;
    }
    const auto low = low_eigenbasis(g, 11, kRun);
    ASSERT_TRUE(low.ok());
    const std::vector<double> one = grid_values(9, 8);
    std::vector<double> expected(4, 0.0);
    for (const double v : one) expected.insert(expected.end(), 5, v);
    ASSERT_EQ(low->values.size(), 14U);
    for (std::size_t k = 0; k < 14; ++k) EXPECT_NEAR(low->values[k], expected[k], 1e-12);
    EXPECT_LT(residual(g, *low), 1e-12);
    expect_orthonormal(low->modes);
}

TEST(LowModes, EdgelessAndCompleteGraphsHaveNoCutSoNoModes) {
    EXPECT_EQ(low_eigenbasis({1000, {}}, 8, kRun)->modes.columns, 0U);
    EXPECT_EQ(low_eigenbasis(complete_graph(40), 8, kRun)->modes.columns, 0U);
    EXPECT_EQ(low_eigenbasis(complete_graph(9), 8, kRun)->modes.columns, 8U);
    EXPECT_EQ(low_eigenbasis({1, {}}, 8, kRun)->modes.columns, 0U);
}

TEST(LowModes, Property4SameBytesAgain) {
    const AdjacencyGraph g = grid_graph(30, 25);
    EXPECT_EQ(low_eigenbasis(g, 12, kRun)->modes.values, low_eigenbasis(g, 12, kRun)->modes.values);
}

TEST(SparseFactor, CountsNegativeEigenvaluesAndSolves) {
    const int count = tries(60);
    for (int seed = 1; seed <= count; ++seed) {
        SCOPED_TRACE(seed);
        Random random(static_cast<std::uint64_t>(seed));
        const std::size_t n = 1 + random.below(30);
        dense::Matrix full(n, n);
        sparse::Symmetric m{n, {0}, {}, {}};
        for (std::size_t j = 0; j < n; ++j) {
            for (std::size_t i = 0; i <= j; ++i) {
                if (i != j && random.below(3) != 0) continue;
                const double v = random.between(-2.0, 2.0);
                full(i, j) = full(j, i) = v;
                m.rows.push_back(static_cast<int>(i));
                m.values.push_back(v);
            }
            m.starts.push_back(static_cast<int>(m.rows.size()));
        }
        sparse::Factor factor(m);
        ASSERT_TRUE(factor.complete());
        const auto eigen = dense::symmetric_eigen(full);
        EXPECT_EQ(factor.negative_pivots(),
                  static_cast<std::size_t>(std::ranges::count_if(eigen.values, [](double v) { return v < 0.0; })));
        dense::Matrix definite = full;  // solving is for definite matrices
        for (std::size_t j = 0; j < n; ++j) {
            definite(j, j) += 4.0 * static_cast<double>(n);
            m.values[static_cast<std::size_t>(m.starts[j + 1] - 1)] = definite(j, j);
        }
        dense::Matrix x(n, 11);
        for (double& v : x.values) v = random.between(-1.0, 1.0);
        dense::Matrix b = times(definite, x);
        sparse::Factor(m).solve(b.values, 11);
        EXPECT_LT(largest_difference(b, x), 1e-11);
    }
}

/// k columns of a random orthonormal basis of the vectors with sum 0.
dense::Matrix random_modes(Random& random, std::size_t n, std::size_t k) {
    return column_block(times(laplacian_eigenbasis(complete_graph(n)).modes, random_basis(random, n - 1)), 0, k);
}

TEST(SubspaceTurn, Property1And2TakesSourceToTargetByARotation) {
    const int count = tries(40);
    for (int seed = 1; seed <= count; ++seed) {
        SCOPED_TRACE(seed);
        Random random(static_cast<std::uint64_t>(seed));
        const std::size_t n = 6 + random.below(20), k = 1 + random.below(n - 2);
        const dense::Matrix s = random_modes(random, n, k);
        dense::Matrix t = random_modes(random, n, k), overlap = times(transposed(s), t);
        if (dense::determinant_sign(overlap) < 0.0) {
            for (double& x : t.column(0)) x = -x;
            overlap = times(transposed(s), t);
        }
        const SubspaceTurn turn = subspace_turn(s, t, overlap);
        const std::size_t d = turn.basis.columns;
        EXPECT_GE(d, k);
        EXPECT_LE(d, 2 * k);
        EXPECT_LT(largest_difference(times(transposed(turn.basis), turn.basis), identity(d)), 1e-12);
        EXPECT_LT(largest_difference(times(transposed(turn.turn), turn.turn), identity(d)), 1e-12);
        EXPECT_EQ(dense::determinant_sign(turn.turn), 1.0);
        EXPECT_EQ(column_block(turn.basis, 0, k).values, s.values);
        EXPECT_LT(largest_difference(times(turn.basis, column_block(turn.turn, 0, k)), t), 1e-11);
    }
}

TEST(SubspaceTurn, Property1SquareSpansTurnByQuarters) {
    const dense::Matrix modes = laplacian_eigenbasis(cycle_graph(12)).modes;
    const dense::Matrix s = column_block(modes, 0, 3), t = column_block(modes, 5, 8);
    const SubspaceTurn turn = subspace_turn(s, t, times(transposed(s), t));
    ASSERT_EQ(turn.basis.columns, 6U);
    EXPECT_LT(largest_difference(times(turn.basis, column_block(turn.turn, 0, 3)), t), 1e-12);
    // The square of a quarter turn in every plane is -1.
    dense::Matrix minus = identity(6);
    for (double& x : minus.values) x = -x;
    EXPECT_LT(largest_difference(times(turn.turn, turn.turn), minus), 1e-12);
}

TEST(SubspaceTurn, ReducedBasisKeepsTheEigenvectorsNearestToTheOther) {
    const Eigenbasis cycle = laplacian_eigenbasis(cycle_graph(12));  // pairs
    const Eigenbasis part = reduced_basis(cycle, 3, cycle);
    ASSERT_EQ(part.modes.columns, 3U);
    ASSERT_EQ(part.spaces.size(), 2U);
    EXPECT_EQ(part.spaces[1].dimension(), 1U);
    EXPECT_LT(residual(cycle_graph(12), part), 1e-12);
    Eigenbasis other = cycle;  // holds one direction of the cut pair alone: that one must stay
    dense::Matrix kept(12, 1);
    for (std::size_t i = 0; i < 12; ++i) kept(i, 0) = 0.6 * cycle.modes(i, 2) - 0.8 * cycle.modes(i, 3);
    other.modes = kept;
    const dense::Matrix overlap = times(transposed(reduced_basis(cycle, 3, other).modes), kept);
    EXPECT_NEAR(std::abs(overlap(2, 0)), 1.0, 1e-12);
}

}  // namespace
}  // namespace aerogram::planner
