#include "planner/transition/eigenbasis.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/unit/planner/transition/shapes.hpp"

namespace aerogram::planner {
namespace {

using namespace testing;

void expect_eigenbasis(const AdjacencyGraph& graph, const Eigenbasis& basis) {
    const std::size_t n = graph.n;
    ASSERT_EQ(basis.modes.rows, n);
    ASSERT_EQ(basis.modes.columns, n - 1);
    EXPECT_LT(largest_difference(times(transposed(basis.modes), basis.modes), identity(n - 1)), 1e-13);
    const double tolerance = 1e-12 + (basis.values.empty() ? 0.0 : 1e-5 * basis.values.back());
    for (std::size_t k = 0; k + 1 < n; ++k) {
        const auto mode = basis.modes.column(k);
        double sum = 0.0;
        std::vector<double> image(n, 0.0);
        for (const Edge& e : graph.edges) {
            image[e.a] += e.weight * (mode[e.a] - mode[e.b]);
            image[e.b] += e.weight * (mode[e.b] - mode[e.a]);
        }
        for (std::size_t i = 0; i < n; ++i) {
            sum += mode[i];
            EXPECT_NEAR(image[i], basis.values[k] * mode[i], tolerance);
        }
        EXPECT_LT(std::abs(sum), 1e-13);
    }
}

TEST(Eigenbasis, Property1And2HoldOnRandomGraphs) {
    const int count = tries(20);
    for (int seed = 1; seed <= count; ++seed) {
        SCOPED_TRACE(seed);
        Random random(static_cast<std::uint64_t>(seed));
        const Points points = random_points(random, 1 + random.below(40));
        const AdjacencyGraph graph = nearest_graph(points, 4);
        expect_eigenbasis(graph, laplacian_eigenbasis(graph));
    }
}

TEST(Eigenbasis, CycleHasTheKnownEigenvaluesInPairs) {
    const Eigenbasis basis = laplacian_eigenbasis(cycle_graph(9));
    ASSERT_EQ(basis.spaces.size(), 4U);
    for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_EQ(basis.spaces[k].dimension(), 2U);
        const double expected = 2.0 - 2.0 * std::cos(2.0 * std::numbers::pi * static_cast<double>(k + 1) / 9.0);
        EXPECT_NEAR(basis.values[2 * k], expected, 1e-13);
        EXPECT_NEAR(basis.values[2 * k + 1], expected, 1e-13);
    }
}

TEST(Eigenbasis, CompleteGraphIsOneEigenspace) {
    const Eigenbasis basis = laplacian_eigenbasis(complete_graph(7));
    ASSERT_EQ(basis.spaces.size(), 1U);
    EXPECT_EQ(basis.spaces[0].dimension(), 6U);
    EXPECT_NEAR(basis.values[0], 7.0, 1e-13);
    expect_eigenbasis(complete_graph(7), basis);
}

TEST(Eigenbasis, DisconnectedGraphKeepsTheConstantVectorOutOfItsKernel) {
    AdjacencyGraph graph{7, {{0, 1, 1.0}, {1, 2, 0.5}, {3, 4, 2.0}}};  // {0 1 2} {3 4} {5} {6}
    const Eigenbasis basis = laplacian_eigenbasis(graph);
    expect_eigenbasis(graph, basis);
    ASSERT_GE(basis.spaces.size(), 1U);
    EXPECT_EQ(basis.spaces[0].dimension(), 3U);  // four components, one dimension is the constant vector
    EXPECT_NEAR(basis.values[2], 0.0, 1e-14);
    EXPECT_GT(basis.values[3], 0.1);
}

TEST(Eigenbasis, NoEdgesIsOneEigenspaceOfZeros) {
    const Eigenbasis basis = laplacian_eigenbasis(AdjacencyGraph{5, {}});
    ASSERT_EQ(basis.spaces.size(), 1U);
    EXPECT_EQ(basis.spaces[0].dimension(), 4U);
    expect_eigenbasis(AdjacencyGraph{5, {}}, basis);
}

TEST(Eigenbasis, Property3CanonicalBasisDependsOnTheSpanAlone) {
    const int count = tries(50);
    for (int seed = 1; seed <= count; ++seed) {
        SCOPED_TRACE(seed);
        Random random(static_cast<std::uint64_t>(seed));
        const std::size_t n = 2 + random.below(20), m = 1 + random.below(n);
        const dense::Matrix columns = column_block(random_basis(random, n), 0, m);
        const dense::Matrix other = times(columns, random_basis(random, m));
        EXPECT_LT(largest_difference(canonical_basis(columns), canonical_basis(other)), 1e-10);
        const dense::Matrix canonical = canonical_basis(columns);
        EXPECT_LT(largest_difference(times(transposed(canonical), canonical), identity(m)), 1e-13);
        EXPECT_LT(largest_difference(times(canonical, transposed(canonical)), times(columns, transposed(columns))),
                  1e-13);
    }
}

TEST(Eigenbasis, CanonicalSignMakesTheLargestEntryPositive) {
    dense::Matrix column(3, 1);
    column.values = {0.6, -0.8, 0.0};
    EXPECT_NEAR(canonical_basis(column)(1, 0), 0.8, 1e-15);
    column.values = {-std::sqrt(0.5), std::sqrt(0.5), 0.0};  // a tie: the first
    EXPECT_GT(canonical_basis(column)(0, 0), 0.0);
}

TEST(Eigenbasis, RefusesEdgesThatAreNotEdges) {
    EXPECT_THROW((void)laplacian_eigenbasis(AdjacencyGraph{2, {{0, 2, 1.0}}}), ContractViolation);
    EXPECT_THROW((void)laplacian_eigenbasis(AdjacencyGraph{2, {{0, 1, -1.0}}}), ContractViolation);
    EXPECT_THROW((void)laplacian_eigenbasis(AdjacencyGraph{0, {}}), ContractViolation);
}

}  // namespace
}  // namespace aerogram::planner
