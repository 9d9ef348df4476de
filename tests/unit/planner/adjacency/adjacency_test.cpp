#include "planner/adjacency/adjacency.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "geo/contract.hpp"
#include "tests/unit/planner/adjacency/formations.hpp"

namespace aerogram::planner {
namespace {

using namespace testing;

const std::vector<Motion>& motions() {
    static const std::vector<Motion> all{{{0.5235987755982988, 0, 0}, {0, 0, 40}},
                                         {{0, 0, 0.7853981633974483}, {-120.5, 33.25, 61}},
                                         {{0.3, -1.1, 2.4}, {3.7, -2.9, 55.1}},
                                         {{-2.9, 0.01, 1e-3}, {900.1, 800.3, 120.7}}};
    return all;
}

void expect_moves_along(const Points& points, const char* name) {
    const AdjacencyGraph graph = delaunay_adjacency(points);
    EXPECT_TRUE(is_connected(graph)) << name;
    for (const Motion& motion : motions()) {
        const AdjacencyGraph moved = delaunay_adjacency(motion(points));
        ASSERT_EQ(pairs_of(moved), pairs_of(graph)) << name;
        for (std::size_t e = 0; e < graph.edges.size(); ++e)
            EXPECT_NEAR(moved.edges[e].weight, graph.edges[e].weight, 1e-9 * graph.edges[e].weight) << name;
    }
}

TEST(Adjacency, OneTwoAndThreeDrones) {
    EXPECT_TRUE(delaunay_adjacency(Points{{1, 2, 3}}).edges.empty());
    EXPECT_EQ(delaunay_adjacency(Points{{0, 0, 0}, {0, 0, 4}}).edges, (std::vector<Edge>{{0, 1, 0.25}}));
    EXPECT_EQ(pairs_of(delaunay_adjacency(Points{{0, 0, 0}, {4, 0, 0}, {1, 0, 3}})), (Pairs{{0, 1}, {0, 2}, {1, 2}}));
}

TEST(Adjacency, TetrahedronJoinsAll) {
    const AdjacencyGraph graph = delaunay_adjacency(Points{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}});
    EXPECT_EQ(graph.edges.size(), 6U);
    EXPECT_DOUBLE_EQ(graph.edges[0].weight, 0.5);
}

TEST(Adjacency, RowIsAChainInOrderOfPlace) {
    const Points row{{6, 6, 6}, {0, 0, 0}, {3, 3, 3}, {1, 1, 1}};
    EXPECT_EQ(pairs_of(delaunay_adjacency(row)), (Pairs{{1, 3}, {2, 3}, {0, 2}}));
}

TEST(Adjacency, GridJoinsRowsAndColumnsWithoutDiagonals) {
    Pairs expected;
    for (std::uint32_t r = 0; r < 4; ++r)
        for (std::uint32_t c = 0; c < 5; ++c) {
            if (c + 1 < 5) expected.emplace(r * 5 + c, r * 5 + c + 1);
            if (r + 1 < 4) expected.emplace(r * 5 + c, r * 5 + c + 5);
        }
    EXPECT_EQ(pairs_of(delaunay_adjacency(grid(5, 4, 2.2))), expected);
}

TEST(Adjacency, CircleIsARing) {
    Pairs ring;
    for (std::uint32_t i = 0; i < 30; ++i) ring.emplace(std::min(i, (i + 1) % 30), std::max(i, (i + 1) % 30));
    EXPECT_EQ(pairs_of(delaunay_adjacency(circle(30, 12.0))), ring);
}

// A ball with everybody on its surface is one Delaunay cell: its faces, by Euler's formula 3n - 6 edges, none through
// the ball.
TEST(Adjacency, SphereIsItsSurface) {
    const AdjacencyGraph graph = delaunay_adjacency(sphere(200, 20.0));
    EXPECT_EQ(graph.edges.size(), 3U * 200U - 6U);
    for (const Edge& e : graph.edges) EXPECT_LT(1.0 / e.weight, 12.0);
}

TEST(Adjacency, CubeLatticeJoinsAlongItsAxes) {
    const AdjacencyGraph graph = delaunay_adjacency(cube(4, 3.0));
    EXPECT_EQ(graph.edges.size(), 3U * 3U * 4U * 4U);
    for (const Edge& e : graph.edges) EXPECT_DOUBLE_EQ(e.weight, 1.0 / 3.0);
}

TEST(Adjacency, CoincidentPointsAreJoinedAndStandForOne) {
    const Points points{{0, 0, 0}, {2, 0, 0}, {0, 0, 0}, {0, 0, 4}, {0, 0, 0}};
    EXPECT_EQ(delaunay_adjacency(points).edges,
              (std::vector<Edge>{
                  {0, 1, 0.5}, {0, 2, 0.5}, {0, 3, 0.25}, {0, 4, 0.5}, {1, 3, 1.0 / std::sqrt(20.0)}, {2, 4, 0.5}}));
    EXPECT_EQ(delaunay_adjacency(Points(3, {5, 5, 5})).edges,
              (std::vector<Edge>{{0, 1, 1.0}, {0, 2, 1.0}, {1, 2, 1.0}}));
}

TEST(Adjacency, PointsOverOneAnotherInAFlatFormationStayJoined) {
    Points points = grid(6, 6, 2.0);
    points.push_back(points[14] + Vec3{0, 0.2, 0});
    const AdjacencyGraph graph = delaunay_adjacency(points);
    EXPECT_TRUE(is_connected(graph));
    EXPECT_TRUE(pairs_of(graph).contains({14, 36}));
    for (const Edge& e : graph.edges)
        if (e.a == 14 && e.b == 36) {
            EXPECT_DOUBLE_EQ(1.0 / e.weight, 0.2);
        }
}

TEST(Adjacency, NotANumberIsRefused) {
    EXPECT_THROW((void)delaunay_adjacency(Points{{0, 0, 0}, {0, std::numeric_limits<double>::quiet_NaN(), 0}}),
                 ContractViolation);
    EXPECT_THROW((void)delaunay_adjacency(Points{}), ContractViolation);
}

TEST(Adjacency, NoiseOffThePlaneLeavesLettersAlone) {
    for (const Points& letter : {letter_t(), letter_h(), letter_e(), letter_n(), grid(8, 5, 2.0)})
        for (const double noise_m : {1e-9, 1e-6, 1e-4, 1e-3, 1e-2}) {
            Random random(5);
            Points noisy = letter;
            for (Vec3& p : noisy) p.y += random.in(-noise_m, noise_m);
            EXPECT_EQ(pairs_of(delaunay_adjacency(noisy)), pairs_of(delaunay_adjacency(letter))) << noise_m;
        }
}

// Points written with millimetres, the letter turned by 30 degrees: collinear and cocircular only to 0.5 mm.
TEST(Adjacency, RoundingToMillimetresLeavesAGridAlone) {
    Points rounded = motions()[2](grid(7, 6, 2.2));
    for (Vec3& p : rounded)
        for (int k = 0; k < 3; ++k) p[k] = std::round(p[k] * 1e3) / 1e3;
    EXPECT_EQ(pairs_of(delaunay_adjacency(rounded)), pairs_of(delaunay_adjacency(grid(7, 6, 2.2))));
}

TEST(Adjacency, SheetSomewhatThickHasNoEdgesAcrossIt) {
    for (const double noise_m : {0.6, 1.0, 2.0}) {
        Random random(6);
        Points sheet = grid(15, 15, 2.0);
        for (Vec3& p : sheet) p.y += random.in(-noise_m, noise_m);
        const AdjacencyGraph graph = delaunay_adjacency(sheet);
        EXPECT_TRUE(is_connected(graph));
        for (const Edge& e : graph.edges) EXPECT_LT(1.0 / e.weight, 3.0 * 5.0) << noise_m;
    }
}

// A lone drone far from a flat letter makes the formation solid; the letter's slivers must not join its far ends.
TEST(Adjacency, LetterWithOneDroneOffItsPlaneKeepsItsOwnEdges) {
    Points points = letter_t();
    const Pairs flat = pairs_of(delaunay_adjacency(points));
    const auto lone = static_cast<std::uint32_t>(points.size());
    points.emplace_back(1.3, 9.0, 11.7);
    for (const Motion& motion : motions()) {
        for (const auto& pair : pairs_of(delaunay_adjacency(motion(points))))
            EXPECT_TRUE(pair.second == lone || flat.contains(pair)) << pair.first << ' ' << pair.second;
    }
}

TEST(AdjacencyProperty1, Connected) {
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        Points points = random_points(1 + random.bits() % 60, seed);
        if (seed % 3 == 1)
            for (Vec3& p : points) p.y *= std::pow(10.0, -static_cast<double>(seed % 12));
        if (seed % 3 == 2)
            for (Vec3& p : points) p = Vec3{std::round(p.x / 5), std::round(p.y / 5), std::round(p.z / 5)};
        EXPECT_TRUE(is_connected(delaunay_adjacency(points)));
    }
}

TEST(AdjacencyProperty2, PermutingPointsPermutesTheGraph) {
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        SCOPED_TRACE(seed);
        Points points = random_points(5 + seed, seed);
        if (seed % 2 == 0)
            for (Vec3& p : points) p.y = 0.0;
        Random random(seed);
        std::vector<std::uint32_t> to(points.size());
        std::iota(to.begin(), to.end(), 0U);
        for (std::size_t i = to.size(); i-- > 1;) std::swap(to[i], to[random.bits() % (i + 1)]);
        Points permuted(points.size());
        for (std::size_t i = 0; i < to.size(); ++i) permuted[to[i]] = points[i];
        Pairs expected;
        for (const auto& [a, b] : pairs_of(delaunay_adjacency(points)))
            expected.emplace(std::min(to[a], to[b]), std::max(to[a], to[b]));
        EXPECT_EQ(pairs_of(delaunay_adjacency(permuted)), expected);
    }
}

TEST(AdjacencyProperty3, RigidMotionsLeaveSymmetricFormationsAlone) {
    expect_moves_along(letter_t(), "T");
    expect_moves_along(letter_h(), "H");
    expect_moves_along(letter_e(), "E");
    expect_moves_along(letter_n(), "N");
    expect_moves_along(grid(9, 7, 2.2), "grid");
    expect_moves_along(grid(12, 1, 2.2), "row");
    expect_moves_along(circle(24, 9.0), "circle");
    expect_moves_along(cube(4, 2.5), "cube");
    expect_moves_along(sphere(150, 15.0), "sphere");
    expect_moves_along(random_points(80, 3), "random");
}

// Brute force: a pair is a Delaunay edge exactly when it belongs to a tetrahedron whose circumscribed ball holds nobody
// else.
Pairs brute_force_edges(const Points& p) {
    Pairs edges;
    const auto n = static_cast<std::uint32_t>(p.size());
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = i + 1; j < n; ++j)
            for (std::uint32_t k = j + 1; k < n; ++k)
                for (std::uint32_t l = k + 1; l < n; ++l) {
                    const Vec3 a = p[j] - p[i], b = p[k] - p[i], c = p[l] - p[i];
                    const Vec3 center = (glm::cross(b, c) * glm::dot(a, a) + glm::cross(c, a) * glm::dot(b, b) +
                                         glm::cross(a, b) * glm::dot(c, c)) /
                                        (2.0 * glm::dot(a, glm::cross(b, c)));
                    bool empty = true;
                    for (std::uint32_t m = 0; m < n && empty; ++m)
                        empty = m == i || m == j || m == k || m == l ||
                                glm::length(p[m] - p[i] - center) > glm::length(center);
                    if (!empty) continue;
                    for (const auto& [u, v] : Pairs{{i, j}, {i, k}, {i, l}, {j, k}, {j, l}, {k, l}})
                        edges.emplace(u, v);
                }
    return edges;
}

TEST(AdjacencyProperty4, EdgesAreDelaunayEdgesAndFewAreTies) {
    std::size_t all = 0, missing = 0;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        SCOPED_TRACE(seed);
        const Points points = random_points(18, seed);
        const Pairs expected = brute_force_edges(points), found = pairs_of(delaunay_adjacency(points));
        EXPECT_TRUE(std::includes(expected.begin(), expected.end(), found.begin(), found.end()));
        all += expected.size();
        missing += expected.size() - found.size();
    }
    EXPECT_LT(static_cast<double>(missing), 0.03 * static_cast<double>(all));
}

}  // namespace
}  // namespace aerogram::planner
