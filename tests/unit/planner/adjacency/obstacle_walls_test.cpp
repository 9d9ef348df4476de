#include "planner/adjacency/obstacle_walls.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <stop_token>

#include "geo/random.hpp"
#include "planner/adjacency/subgraph.hpp"
#include "planner/mesh/mesh_faults.hpp"
#include "planner/mesh/mesh_measure.hpp"

namespace aerogram::planner {
namespace {

using geo::Cylinder;
using geo::Obstacle;
using geo::Prism;

Obstacle mast(const Vec2& at, double radius_m, double height_m = 80.0) {
    return {"mast", Cylinder{at, radius_m}, 0.0, height_m};
}
Obstacle house(const Vec2& low, const Vec2& high, double height_m = 80.0) {
    return {"house", Prism{{{low.x, low.y}, {high.x, low.y}, {high.x, high.y}, {low.x, high.y}}}, 0.0, height_m};
}
/// An L, turning right: not convex.
Obstacle corner() {
    return {"corner", Prism{{{0, 0}, {0, 6}, {2, 6}, {2, 2}, {6, 2}, {6, 0}}}, 10.0, 20.0};
}

/// By many places along the way.
bool is_inside_somewhere(const Obstacle& o, const Vec3& a, const Vec3& b, double depth_m, int places = 10'000) {
    for (int k = 0; k <= places; ++k)
        if (geo::clearance(o, a + (static_cast<double>(k) / places) * (b - a)) < -depth_m) return true;
    return false;
}

TEST(PassesThrough, AgreesWithPlacesAlongTheWay) {
    Random random(3);
    std::size_t through = 0;
    for (const Obstacle& o : {mast({2, 3}, 2.0, 25.0), house({0, 0}, {3, 5}, 25.0), corner()})
        for (int i = 0; i < 300; ++i) {
            const auto place = [&] {
                return Vec3{random.between(-4, 9), random.between(-4, 9), random.between(-3, 35)};
            };
            const Vec3 a = place(), b = place();
            if (passes_through(o, a, b)) ++through;
            if (is_inside_somewhere(o, a, b, 1e-6)) {
                EXPECT_TRUE(passes_through(o, a, b));
            }
            if (!is_inside_somewhere(o, a, b, -2e-3)) {  // not even near
                EXPECT_FALSE(passes_through(o, a, b));
            }
            EXPECT_EQ(passes_through(o, a, b), passes_through(o, b, a));
        }
    EXPECT_GT(through, 100U);
}

TEST(PassesThrough, TouchingDoesNotCount) {
    const Obstacle o = house({0, 0}, {2, 2}, 10.0);
    EXPECT_FALSE(passes_through(o, {-5, 0, 5}, {5, 0, 5}));    // along a side
    EXPECT_FALSE(passes_through(o, {-1, 1, 5}, {1, -1, 5}));   // over an edge
    EXPECT_FALSE(passes_through(o, {-5, 1, 10}, {5, 1, 10}));  // over the roof
    EXPECT_TRUE(passes_through(o, {-5, 1, 9.9}, {5, 1, 9.9}));
    EXPECT_FALSE(passes_through(mast({0, 0}, 2.0), {-5, 2, 5}, {5, 2, 5}));
    EXPECT_TRUE(passes_through(mast({0, 0}, 2.0), {-5, 1.99, 5}, {5, 1.99, 5}));
    EXPECT_TRUE(passes_through(mast({0, 0}, 2.0), {0, 0, 90}, {0, 0, 70}));
    EXPECT_FALSE(passes_through(mast({0, 0}, 2.0), {0, 0, 90}, {0, 0, 80}));
}

TEST(WallOf, EnclosesTheObstacle) {
    for (const Obstacle& o : {house({0, 0}, {3, 5}), corner()}) {
        const TriangleMesh wall = wall_of(o);
        EXPECT_EQ(faults_of(wall), "");
        EXPECT_NEAR(enclosed_volume(wall), o.name == "house" ? 15.0 * 80.0 : 20.0 * 20.0, 1e-9);
    }
    const TriangleMesh round = wall_of(mast({5, -7}, 2.0), 48);
    EXPECT_EQ(faults_of(round), "");
    const double around = 48.0 * 4.0 * std::tan(std::numbers::pi / 48.0);  // circumscribed
    EXPECT_NEAR(enclosed_volume(round), around * 80.0, 1e-9);
    // Corners that are none, and a comb whose ears are few.
    Prism comb{{{0, 0}, {5, 0}, {10, 0}}};
    for (int tooth = 9; tooth >= 0; --tooth) {
        comb.outline_m.push_back({tooth + 0.8, 4.0});
        comb.outline_m.push_back({tooth + 0.4, 1.0});
    }
    const TriangleMesh wall = wall_of({"comb", comb, 0.0, 1.0});
    EXPECT_EQ(faults_of(wall), "");
}

Points grid(int columns, int rows, double spacing_m, const Vec3& right, const Vec3& up, const Vec3& center) {
    Points points;
    for (int r = 0; r < rows; ++r)
        for (int c = 0; c < columns; ++c)
            points.push_back(center + spacing_m * ((c - 0.5 * (columns - 1)) * right + (r - 0.5 * (rows - 1)) * up));
    return points;
}

std::set<std::pair<std::uint32_t, std::uint32_t>> pairs_of(const AdjacencyGraph& graph) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (const Edge& e : graph.edges) pairs.insert({e.a, e.b});
    return pairs;
}

/// What the header promises, by brute force. @returns the number of edges that were in the way.
std::size_t expect_properties(const Points& drones_m, const std::vector<Obstacle>& solids) {
    const auto around = adjacency_around(drones_m, {}, solids, aerogram::Run{});
    EXPECT_TRUE(around.ok()) << around.error().message;
    if (!around) return 0;
    const AdjacencyGraph plain = delaunay_adjacency(drones_m);
    std::vector<bool> lost(drones_m.size(), false);
    std::set<std::pair<std::uint32_t, std::uint32_t>> kept, all = pairs_of(plain);
    for (const Edge& e : plain.edges) {
        const bool through = std::any_of(solids.begin(), solids.end(), [&](const Obstacle& o) {
            return passes_through(o, drones_m[e.a], drones_m[e.b]);
        });
        if (through)
            lost[e.a] = lost[e.b] = true;
        else
            kept.insert({e.a, e.b});
    }
    const auto now = pairs_of(*around);
    EXPECT_EQ(now.size(), around->edges.size());
    EXPECT_TRUE(std::includes(now.begin(), now.end(), kept.begin(), kept.end()));
    for (const Edge& e : around->edges) {
        for (const Obstacle& o : solids) EXPECT_FALSE(is_inside_somewhere(o, drones_m[e.a], drones_m[e.b], 1e-6, 1000));
        if (kept.contains({e.a, e.b})) continue;
        EXPECT_TRUE(lost[e.a] && lost[e.b] && !all.contains({e.a, e.b}));
        EXPECT_DOUBLE_EQ(e.weight, 1.0 / glm::length(drones_m[e.b] - drones_m[e.a]));
    }
    EXPECT_TRUE(std::is_sorted(around->edges.begin(), around->edges.end(),
                               [](const Edge& p, const Edge& q) { return std::pair(p.a, p.b) < std::pair(q.a, q.b); }));
    return all.size() - kept.size();
}

TEST(AdjacencyAround, Properties123_SolidFormations) {
    Random random(1);
    std::size_t cut = 0;
    for (int round = 0; round < 6; ++round) {
        const std::vector<Obstacle> solids{mast({3, 0}, 1.5), house({-6, -8}, {-5, 8}, 40.0), corner()};
        Points drones;
        while (drones.size() < 150) {
            const Vec3 p{random.between(-10, 10), random.between(-10, 10), random.between(20, 40)};
            if (std::all_of(solids.begin(), solids.end(),
                            [&](const Obstacle& o) { return geo::clearance(o, p) > 0.2; }))
                drones.push_back(p);
        }
        cut += expect_properties(drones, solids);
    }
    EXPECT_GT(cut, 100U);
}

TEST(AdjacencyAround, Properties123_FlatFormationsAndRows) {
    const std::vector<Obstacle> solids{mast({0, 0}, 1.0)};
    EXPECT_EQ(expect_properties(grid(10, 6, 3.0, {1, 0, 0}, {0, 0, 1}, {0, 0, 30}), solids), 6U);  // a wall, upright
    EXPECT_GT(expect_properties(grid(9, 8, 1.5, {1, 0, 0}, {0, 1, 0}, {0, 0, 30}), solids), 0U);   // lying
    EXPECT_EQ(expect_properties(grid(8, 1, 3.0, {1, 0, 0}, {0, 0, 1}, {0, 0, 30}), solids), 1U);   // a row
    EXPECT_EQ(expect_properties({{-3, 0, 10}, {3, 0, 10}}, solids), 1U);
    EXPECT_EQ(expect_properties({{3, 0, 10}}, solids), 0U);
}

TEST(AdjacencyAround, Property2_WithoutAnEdgeInTheWayNothingChanges) {
    const Points wall = grid(10, 6, 3.0, {1, 0, 0}, {0, 0, 1}, {-30, 0, 30});
    const auto around = adjacency_around(wall, {}, {mast({0, 0}, 2.0)}, aerogram::Run{});
    ASSERT_TRUE(around.ok());
    EXPECT_EQ(around->edges, delaunay_adjacency(wall).edges);
    // Nor where the mast stands between the drones without touching an edge.
    const auto between =
        adjacency_around(grid(10, 6, 3.0, {1, 0, 0}, {0, 1, 0}, {0, 0, 30}), {}, {mast({0, 0}, 1.4)}, aerogram::Run{});
    EXPECT_EQ(between->edges, delaunay_adjacency(grid(10, 6, 3.0, {1, 0, 0}, {0, 1, 0}, {0, 0, 30})).edges);
}

TEST(AdjacencyAround, AWallPartsAFormation) {
    const auto parts = [](double height_m) {
        const auto around = adjacency_around(grid(10, 6, 3.0, {1, 0, 0}, {0, 0, 1}, {0, 0, 30}), {},
                                             {mast({0, 0}, 1.0, height_m)}, aerogram::Run{});
        const auto component = components_of(*around);
        return 1 + *std::max_element(component.begin(), component.end());
    };
    EXPECT_EQ(parts(80.0), 2U);
    EXPECT_EQ(parts(36.0), 1U);  // the highest row, at 37.5 m, holds together
}

// Two rows, staggered, either side of a thin screen: nobody on one side has a neighbour on the same side by Delaunay's
// rule, because those on the other are nearer. Behind the screen they do not count.
TEST(AdjacencyAround, WhoIsHiddenDoesNotStandBetween) {
    Points drones;
    for (int i = 0; i < 8; ++i) drones.push_back({4.0 * i, -0.5, 20.0});
    for (int i = 0; i < 7; ++i) drones.push_back({4.0 * i + 2.0, 0.5, 20.0});
    drones.push_back({14.0, 0.0, 50.0});  // so that it is a solid formation
    drones.push_back({14.0, 3.0, 50.0});
    const std::vector<Obstacle> screen{house({-5, -0.1}, {40, 0.1}, 40.0)};
    expect_properties(drones, screen);
    const auto around = adjacency_around(drones, {}, screen, aerogram::Run{});
    ASSERT_TRUE(around.ok());
    const auto pairs = pairs_of(*around);
    for (std::uint32_t i = 0; i + 1 < 8; ++i) EXPECT_TRUE(pairs.contains({i, i + 1})) << i;
    for (std::uint32_t i = 8; i + 1 < 15; ++i) EXPECT_TRUE(pairs.contains({i, i + 1})) << i;
}

TEST(AdjacencyAround, ObstaclesMayOverlapAndDronesMayTouchThem) {
    const std::vector<Obstacle> solids{mast({0, 0}, 1.0), mast({0.5, 0}, 1.0), house({-1, -1}, {1, 0.5})};
    expect_properties(grid(10, 6, 3.0, {1, 0, 0}, {0, 0, 1}, {0, 0, 30}), solids);
    Points touching = grid(10, 6, 3.0, {1, 0, 0}, {0, 0, 1}, {0, 0, 30});
    touching.push_back({1.0, 0.0, 30.0});  // on the mast
    touching.push_back({1.0 + 1e-6, 0.0, 31.0});
    touching.push_back(touching[3]);  // where somebody is
    expect_properties(touching, {mast({0, 0}, 1.0)});
    touching.push_back({0.2, 0.0, 30.0});  // inside: somebody else's error, no crash
    EXPECT_TRUE(adjacency_around(touching, {}, {mast({0, 0}, 1.0)}, aerogram::Run{}).ok());
}

TEST(AdjacencyAround, AnObstaclesOwnVertexIsReachedThroughItsOwnWallsOnly) {
    const std::vector<Obstacle> solids{mast({0, 0}, 2.0), house({-12, -6}, {-10, 6})};
    const Points left = grid(2, 6, 3.0, {1, 0, 0}, {0, 0, 1}, {-20, 0, 30}),
                 right = grid(2, 6, 3.0, {1, 0, 0}, {0, 0, 1}, {10, 0, 30});
    Points drones = left;
    drones.insert(drones.end(), right.begin(), right.end());
    const std::vector<double> weights{5.0, 0.0};
    const auto vertices = obstacle_vertices(solids, weights, drones, drones);
    ASSERT_EQ(vertices.size(), 1U);
    const auto around = adjacency_around(drones, vertices, solids, aerogram::Run{});
    ASSERT_TRUE(around.ok()) << around.error().message;
    const auto mast_vertex = static_cast<std::uint32_t>(drones.size());
    std::size_t at_the_mast = 0;
    for (const Edge& e : around->edges) {
        if (e.b != mast_vertex) continue;
        ++at_the_mast;
        EXPECT_GE(e.a, left.size());  // those on the left have the house before it
    }
    EXPECT_GT(at_the_mast, 0U);
}

TEST(AdjacencyAround, StopsWhenAsked) {
    std::stop_source source;
    source.request_stop();
    aerogram::Run run;
    run.stop = source.get_token();
    const auto around = adjacency_around(Points{{-3, 0, 10}, {3, 0, 10}}, {}, {mast({0, 0}, 1.0)}, run);
    ASSERT_FALSE(around.ok());
    EXPECT_EQ(around.error().code, ErrorCode::stopped);
}

}  // namespace
}  // namespace aerogram::planner
