#include "planner/adjacency/subgraph.hpp"

#include <gtest/gtest.h>

#include "geo/random.hpp"
#include "planner/adjacency/obstacle_vertices.hpp"

namespace aerogram::planner {
namespace {

using Dense = std::vector<std::vector<double>>;

Dense laplacian(const AdjacencyGraph& g) {
    Dense l(g.n, std::vector<double>(g.n, 0.0));
    for (const Edge& e : g.edges) {
        l[e.a][e.a] += e.weight;
        l[e.b][e.b] += e.weight;
        l[e.a][e.b] -= e.weight;
        l[e.b][e.a] -= e.weight;
    }
    return l;
}

AdjacencyGraph random_graph(Random& random, std::uint32_t n) {
    AdjacencyGraph g{n, {}};
    for (std::uint32_t a = 0; a < n; ++a) {
        for (std::uint32_t b = a + 1; b < n; ++b) {
            if (random.below(3) == 0) g.edges.push_back({a, b, random.between(0.1, 2.0)});
        }
    }
    return g;
}

TEST(ContractedGraph, Property1ItsLaplacianIsTheOneOfMotionsOfWholes) {
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const auto n = static_cast<std::uint32_t>(1 + random.below(15));
        const std::size_t count = 1 + random.below(5);
        const AdjacencyGraph g = random_graph(random, n);
        std::vector<std::uint32_t> owner(n);
        for (auto& o : owner) o = static_cast<std::uint32_t>(random.below(count));
        const Dense l = laplacian(g), c = laplacian(contracted_graph(g, owner, count));
        Dense expected(count, std::vector<double>(count, 0.0));  // Pᵀ L P
        for (std::uint32_t i = 0; i < n; ++i) {
            for (std::uint32_t j = 0; j < n; ++j) expected[owner[i]][owner[j]] += l[i][j];
        }
        for (std::size_t p = 0; p < count; ++p) {
            for (std::size_t q = 0; q < count; ++q) EXPECT_NEAR(c[p][q], expected[p][q], 1e-12);
        }
    }
}

TEST(ContractedGraph, Property2AConnectedGraphStaysConnected) {
    Random random(7);
    Points points(40);
    for (Vec3& p : points) p = {random.between(0, 50), random.between(0, 50), random.between(0, 50)};
    std::vector<std::uint32_t> owner(40);
    for (std::uint32_t i = 0; i < 40; ++i) owner[i] = i % 7;
    const auto component = components_of(contracted_graph(delaunay_adjacency(points), owner, 7));
    for (const std::uint32_t c : component) EXPECT_EQ(c, 0U);
}

TEST(InducedSubgraph, KeepsEdgesBetweenMembersInTheirOrder) {
    const AdjacencyGraph g{5, {{0, 1, 1.0}, {0, 4, 2.0}, {1, 2, 3.0}, {2, 4, 4.0}, {3, 4, 5.0}}};
    const AdjacencyGraph sub = induced_subgraph(g, std::vector<std::uint32_t>{4, 0, 2});
    EXPECT_EQ(sub.n, 3U);
    EXPECT_EQ(sub.edges, (std::vector<Edge>{{0, 1, 2.0}, {0, 2, 4.0}}));
    EXPECT_THROW((void)induced_subgraph(g, std::vector<std::uint32_t>{1, 1}), ContractViolation);
}

TEST(ComponentsOf, CountUpByTheirLowestVertex) {
    const AdjacencyGraph g{7, {{1, 5, 1.0}, {2, 3, 1.0}, {3, 6, 1.0}}};
    EXPECT_EQ(components_of(g), (std::vector<std::uint32_t>{0, 1, 2, 2, 3, 1, 2}));
}

std::vector<geo::Obstacle> mast_and_house() {
    return {{"mast", geo::Cylinder{{10, 5}, 2.0}, 0.0, 25.0},
            {"house", geo::Prism{{{0, 0}, {4, 0}, {4, 2}, {0, 2}}}, 0.0, 8.0}};
}

TEST(ObstacleVertices, StandOnTheAxisAtTheFormationsHeightAsFarAsTheSolidReaches) {
    const Points from{{0, 0, 10}, {0, 0, 20}}, to{{0, 0, 20}, {0, 0, 30}};
    const auto both = obstacle_vertices(mast_and_house(), std::vector<double>{2.0, 0.5}, from, to);
    ASSERT_EQ(both.size(), 2U);
    EXPECT_EQ(both[0].at_m, Vec3(10, 5, 20));
    EXPECT_EQ(both[1].at_m, Vec3(2, 1, 8));
    EXPECT_EQ(both[1].weight, 0.5);
    const auto one = obstacle_vertices(mast_and_house(), std::vector<double>{0.0, 1.0}, from, to);
    ASSERT_EQ(one.size(), 1U);
    EXPECT_EQ(one[0].at_m, Vec3(2, 1, 8));
}

TEST(ObstacleAdjacency, IsTheTriangulationOfBothWithTheObstaclesWeights) {
    Random random(11);
    Points drones(20);
    for (Vec3& p : drones) p = {random.between(0, 30), random.between(0, 30), random.between(0, 30)};
    EXPECT_EQ(obstacle_adjacency(drones, {}).edges, delaunay_adjacency(drones).edges);
    const std::vector<ObstacleVertex> obstacles{{{15, 15, 15}, 3.0}, {{15, 15, 17}, 0.5}};
    Points all = drones;
    for (const ObstacleVertex& o : obstacles) all.push_back(o.at_m);
    const AdjacencyGraph plain = delaunay_adjacency(all), weighted = obstacle_adjacency(drones, obstacles);
    ASSERT_EQ(plain.edges.size(), weighted.edges.size());
    int at_obstacles = 0;
    for (std::size_t k = 0; k < plain.edges.size(); ++k) {
        const Edge &p = plain.edges[k], &w = weighted.edges[k];
        double factor = 1.0;
        for (const std::uint32_t i : {p.a, p.b}) factor *= i == 20 ? 3.0 : i == 21 ? 0.5 : 1.0;
        EXPECT_DOUBLE_EQ(w.weight, factor * p.weight);
        at_obstacles += p.b >= 20 ? 1 : 0;
    }
    EXPECT_GT(at_obstacles, 4);
}

}  // namespace
}  // namespace aerogram::planner
