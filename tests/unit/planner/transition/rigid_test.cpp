#include "planner/transition/rigid.hpp"

#include <gtest/gtest.h>

#include <stop_token>

#include "moving_bodies.hpp"
#include "planner/transition/alignment.hpp"
#include "planner/transition/rigid_gradients.hpp"
#include "planner/transition/rigid_solver.hpp"
#include "planner/transition/rigid_turns.hpp"
#include "shapes.hpp"

namespace aerogram::planner {
namespace {

using testing::keyframe;
using testing::largest_distance;
using testing::nearest_graph;
using testing::Random;
using testing::random_motion;
using testing::random_points;

Interpolation rigid(const SpectralKeyframe& source, const SpectralKeyframe& target) {
    return std::move(rigid_transition(source, target, Run{})).value();
}
Points at(const Interpolation& path, std::size_t n, double t) {
    Points out(n);
    path(t, out);
    return out;
}
SpectralKeyframe with_graph(Points points_m, AdjacencyGraph graph) {
    SpectralKeyframe out;
    out.positions_m = std::move(points_m);
    out.graph = std::move(graph);
    return out;
}
void expect_ends(const SpectralKeyframe& source, const SpectralKeyframe& target) {
    const Interpolation path = rigid(source, target);
    const std::size_t n = source.positions_m.size();
    EXPECT_LT(largest_distance(at(path, n, 0.0), source.positions_m), 1e-9) << n << " drones";
    EXPECT_LT(largest_distance(at(path, n, 1.0), target.positions_m), 1e-9) << n << " drones";
    for (const Vec3& p : at(path, n, 0.37)) EXPECT_TRUE(is_finite(p)) << n << " drones";
}
/// The largest change of any distance between two of the first n points.
double stretch_m(const Points& before, const Points& now, std::size_t first, std::size_t last) {
    double worst = 0.0;
    for (std::size_t i = first; i < last; ++i) {
        for (std::size_t j = first; j < i; ++j) {
            worst = std::max(worst, std::abs(glm::distance(now[i], now[j]) - glm::distance(before[i], before[j])));
        }
    }
    return worst;
}

TEST(Rigid, Property1_EndsAreTheKeyframes) {
    Random random(1);
    for (int round = 0; round < testing::tries(40); ++round) {
        const std::size_t n = 4 + random.below(40);
        expect_ends(keyframe(random_points(random, n)), keyframe(random_points(random, n)));
    }
}

TEST(Rigid, Property2_AMovedFleetKeepsAllItsDistances) {
    Random random(2);
    for (int round = 0; round < testing::tries(30); ++round) {
        const std::size_t n = 2 + random.below(30);
        const Points from_m = random_points(random, n), to_m = random_motion(random)(from_m);
        const Interpolation path = rigid(keyframe(from_m), keyframe(to_m));
        for (const double t : {0.2, 0.5, 0.9}) {
            const Points now = at(path, n, t);
            EXPECT_LT(stretch_m(from_m, now, 0, n), 1e-9) << "round " << round;
            const Vec3 straight = (1.0 - t) * barycentre(from_m) + t * barycentre(to_m);
            EXPECT_LT(glm::distance(barycentre(now), straight), 1e-9);
        }
    }
}

TEST(Rigid, Property3_RigidMotionsCommute) {
    Random random(3);
    for (int round = 0; round < testing::tries(20); ++round) {
        const std::size_t n = 8 + random.below(30);
        const Points from_m = random_points(random, n), to_m = random_points(random, n);
        const AdjacencyGraph one = nearest_graph(from_m, 5), other = nearest_graph(to_m, 5);
        const testing::RigidMotion motion = random_motion(random);
        const Interpolation path = rigid(with_graph(from_m, one), with_graph(to_m, other));
        const Interpolation moved = rigid(with_graph(motion(from_m), one), with_graph(motion(to_m), other));
        for (const double t : {0.3, 0.5, 0.8}) {
            EXPECT_LT(largest_distance(motion(at(path, n, t)), at(moved, n, t)), 1e-6) << "round " << round;
        }
    }
}

TEST(Rigid, Property4_SmallFlatAndDisconnectedFleetsWork) {
    Random random(4);
    for (std::size_t n = 1; n <= 3; ++n) {
        expect_ends(keyframe(random_points(random, n)), keyframe(random_points(random, n)));
    }
    Points row, back, flat;
    for (int i = 0; i < 12; ++i) {
        row.push_back({2.0 * i, 0.0, 5.0});
        back.push_back({0.0, 2.0 * (11 - i), 8.0});
        flat.push_back({2.0 * (i % 4), 0.0, 2.0 * (i / 4)});
    }
    expect_ends(keyframe(row), keyframe(back));
    expect_ends(keyframe(row), keyframe(Points(row.rbegin(), row.rend())));
    expect_ends(keyframe(flat), keyframe(row));
    expect_ends(keyframe(flat), keyframe(Points(flat.rbegin(), flat.rend())));
    expect_ends(with_graph(row, {12, {}}), with_graph(flat, {12, {}}));
    expect_ends(with_graph(row, {12, {{0, 1, 1.0}, {4, 7, 2.0}}}), with_graph(flat, {12, {{0, 5, 1.0}}}));
}

TEST(Rigid, ABodyApartFromTheOthersIsFlownRigidly) {
    Random random(5);
    for (int round = 0; round < testing::tries(20); ++round) {
        Points from_m, to_m;
        AdjacencyGraph graph{24, {}};
        for (std::uint32_t body = 0; body < 3; ++body) {
            const Points shape = random_points(random, 8, 4.0);
            const testing::RigidMotion place = random_motion(random), goal = random_motion(random);
            for (const Edge& e : nearest_graph(shape, 4).edges) {
                graph.edges.push_back({e.a + 8 * body, e.b + 8 * body, e.weight});
            }
            for (const Vec3& p : place(shape)) from_m.push_back(p);
            for (const Vec3& p : goal(shape)) to_m.push_back(p);
        }
        const Interpolation path = rigid(with_graph(from_m, graph), with_graph(to_m, graph));
        for (const double t : {0.25, 0.5, 0.75}) {
            const Points now = at(path, 24, t);
            for (std::size_t body = 0; body < 3; ++body) {
                EXPECT_LT(stretch_m(from_m, now, 8 * body, 8 * body + 8), 1e-9) << "round " << round;
            }
        }
    }
}

// Turns of just below and just above pi about one axis are far apart as axis and angle in [0, pi]: unless the branches
// are chosen together, neighbours turn opposite ways and the body is torn in the middle.
TEST(Rigid, BodiesThatTurnByAboutPiAreNotTorn) {
    Random random(6);
    for (int round = 0; round < testing::tries(10); ++round) {
        Points from_m, to_m;
        AdjacencyGraph graph{40, {}};
        const Turn whole{random.direction(), std::numbers::pi};
        const Points still = random_points(random, 20, 5.0), turning = random_points(random, 20, 5.0);
        const Vec3 beside{60.0, 0.0, 0.0};
        for (const Vec3& p : still) from_m.push_back(p);
        for (const Vec3& p : turning) from_m.push_back(p + beside);
        for (std::size_t i = 0; i < 40; ++i) {
            // The second body turns by pi, and every drone is off by a little: rings turn by pi +- a few hundredths.
            const Vec3 goal = i < 20 ? still[i] : turned(whole, 1.0, turning[i - 20]) + beside;
            to_m.push_back(goal + 0.05 * random.in_cube(1.0));
        }
        for (const Edge& e : nearest_graph(still, 6).edges) graph.edges.push_back(e);
        graph.edges.push_back({3, 25, 1e-3});
        for (const Edge& e : nearest_graph(turning, 6).edges) graph.edges.push_back({e.a + 20, e.b + 20, e.weight});
        std::ranges::sort(graph.edges, {}, [](const Edge& e) { return std::pair(e.a, e.b); });
        const Interpolation path = rigid(with_graph(from_m, graph), with_graph(to_m, graph));
        Points before = from_m;
        for (int step = 1; step <= 100; ++step) {
            const Points now = at(path, 40, step / 100.0);
            for (const Edge& e : graph.edges) {
                if (e.a == 3 && e.b == 25) continue;
                const double length_m = glm::distance(from_m[e.a], from_m[e.b]);
                EXPECT_NEAR(glm::distance(now[e.a], now[e.b]), length_m, 0.3) << "round " << round;
                const Vec3 change = (now[e.b] - now[e.a]) - (before[e.b] - before[e.a]);
                EXPECT_LT(glm::length(change), 0.05 * length_m + 0.01) << "round " << round << ", step " << step;
            }
            before = now;
        }
    }
}

TEST(Rigid, GroupsThatMoveRoundARingStayTogether) {
    for (const int places : {1, 2}) {
        for (std::uint64_t seed = 1; seed <= 5; ++seed) {
            const bodies::Move move = bodies::ring_of_bodies(places, 1.0, seed);
            const bodies::Quality q = bodies::quality(move, rigid(bodies::source(move), bodies::target(move)));
            EXPECT_LE(q.distortion, 0.012) << places << " places, seed " << seed;
            EXPECT_GE(q.separation, 0.95) << places << " places, seed " << seed;
        }
    }
}

TEST(Rigid, GroupsThatSwapStayTogetherAndPassBeside) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        for (const double own_turn_rad : {0.0, 1.0}) {
            const bodies::Move move = bodies::swapping_bodies(own_turn_rad, seed);
            const bodies::Quality q = bodies::quality(move, rigid(bodies::source(move), bodies::target(move)));
            EXPECT_LE(q.distortion, 0.012) << "seed " << seed;
            EXPECT_GE(q.separation, 0.95) << "seed " << seed;
        }
    }
}

TEST(Rigid, Property5_SameInputSameBytes) {
    Random random(7);
    const SpectralKeyframe source = keyframe(random_points(random, 50)), target = keyframe(random_points(random, 50));
    const Interpolation once = rigid(source, target), again = rigid(source, target);
    at(again, 50, 0.7);  // what was asked before does not count
    EXPECT_EQ(at(once, 50, 0.4), at(again, 50, 0.4));
}

TEST(Rigid, AStopIsHeard) {
    std::stop_source stop;
    stop.request_stop();
    aerogram::Run run;
    run.stop = stop.get_token();
    const SpectralKeyframe one = keyframe({{0, 0, 0}});
    const auto result = rigid_transition(one, one, run);
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().code, ErrorCode::stopped);
}

// Instead of the solver: the least squares' gradient itself, edge by edge.
TEST(RigidSolver, TheLaplacianOfTheAnswerIsTheRightHandSide) {
    Random random(8);
    for (int round = 0; round < testing::tries(20); ++round) {
        const std::size_t n = 2 + random.below(60);
        const RingGraph rings = ring_graph(nearest_graph(random_points(random, n), 3), AdjacencyGraph{n, {}});
        Points b = random_points(random, n);
        for (const std::uint32_t first : rings.first_of) {
            Vec3 sum{};
            for (std::size_t i = 0; i < n; ++i) {
                if (rings.component[i] == rings.component[first]) sum += b[i];
            }
            b[first] -= sum;
        }
        Points direct = b;
        LaplacianSolver(rings).solve(direct);
        for (const Points& x : {direct, laplacian_gradients(rings, b)}) {
            for (std::uint32_t i = 0; i < n; ++i) {
                Vec3 image{};
                for (std::uint32_t k = rings.starts[i]; k < rings.starts[i + 1]; ++k) {
                    image += rings.weights[k] * (x[i] - x[rings.neighbours[k]]);
                }
                EXPECT_LT(glm::distance(image, b[i]), 1e-8) << "round " << round;
            }
        }
    }
}

TEST(RigidTurns, Property1And2_StillFleetsDoNotTurnAndBodiesTurnAsOne) {
    Random random(9);
    for (int round = 0; round < testing::tries(20); ++round) {
        const Points from_m = random_points(random, 30);
        const AdjacencyGraph graph = nearest_graph(from_m, 5);
        const RingGraph rings = ring_graph(graph, graph);
        if (rings.first_of.size() > 1) continue;
        for (const Turn& turn : ring_turns(rings, from_m, from_m, {})) EXPECT_LT(turn.angle_rad, 1e-9);
        const Turn whole{random.direction(), random.between(0.1, 2.0)};
        for (const Turn& turn : ring_turns(rings, from_m, testing::RigidMotion{whole, {}}(from_m), {})) {
            EXPECT_LT(glm::distance(turn.angle_rad * turn.axis, whole.angle_rad * whole.axis), 1e-5);
        }
    }
}

// A row says nothing of turns about itself: it must not make any up, and take over what its neighbours do.
TEST(RigidTurns, StraightRingsFollowTheirNeighbours) {
    Points from_m;
    AdjacencyGraph graph{9, {}};
    for (std::uint32_t i = 0; i < 9; ++i) {
        from_m.push_back({2.0 * i, 0.0, 0.0});
        if (i > 0) graph.edges.push_back({i - 1, i, 1.0});
    }
    const Turn lift{{0, -1, 0}, 0.7};
    const RingGraph rings = ring_graph(graph, graph);
    for (const Turn& turn : ring_turns(rings, from_m, testing::RigidMotion{lift, {}}(from_m), {})) {
        EXPECT_LT(glm::distance(turn.angle_rad * turn.axis, lift.angle_rad * lift.axis), 1e-5);
    }
}

TEST(RingGraph, IsTheUnionWithMeanWeights) {
    const RingGraph rings = ring_graph({4, {{0, 1, 2.0}, {1, 2, 4.0}}}, {4, {{0, 2, 6.0}, {1, 2, 8.0}}});
    EXPECT_EQ(rings.starts, (std::vector<std::uint32_t>{0, 2, 4, 6, 6}));
    EXPECT_EQ(rings.neighbours, (std::vector<std::uint32_t>{1, 2, 0, 2, 0, 1}));
    EXPECT_EQ(rings.weights, (std::vector<double>{2.0, 6.0, 2.0, 6.0, 6.0, 6.0}));
    EXPECT_EQ(rings.component, (std::vector<std::uint32_t>{0, 0, 0, 1}));
    EXPECT_EQ(rings.first_of, (std::vector<std::uint32_t>{0, 3}));
}

}  // namespace
}  // namespace aerogram::planner
