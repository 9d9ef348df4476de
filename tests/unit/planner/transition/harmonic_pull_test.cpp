#include "planner/transition/harmonic_pull.hpp"

#include <gtest/gtest.h>

#include "tests/unit/planner/transition/shapes.hpp"

namespace aerogram::planner {
namespace {

using namespace testing;

TEST(HarmonicPull, Property1And3IsHarmonicAndRowsSumToOneOrZero) {
    const int count = tries(40);
    for (int seed = 1; seed <= count; ++seed) {
        SCOPED_TRACE(seed);
        Random random(static_cast<std::uint64_t>(seed));
        const std::size_t n = 3 + random.below(25), fixed = 1 + random.below(3), free = n - std::min(n - 1, fixed);
        AdjacencyGraph a = nearest_graph(random_points(random, n), 2), b = nearest_graph(random_points(random, n), 1);
        if (seed % 3 == 0) {  // drone 0 has no neighbours
            for (AdjacencyGraph* g : {&a, &b}) std::erase_if(g->edges, [](const Edge& e) { return e.a == 0; });
        }
        const dense::Matrix pull = harmonic_pull(a, b, free);
        dense::Matrix all(n, n - free);  // fixed vertices follow themselves
        for (std::size_t f = 0; f < n - free; ++f) {
            for (std::size_t i = 0; i < free; ++i) all(i, f) = pull(i, f);
            all(free + f, f) = 1.0;
        }
        for (std::size_t i = 0; i < free; ++i) {
            double row = 0.0;
            for (std::size_t f = 0; f < n - free; ++f) {
                row += pull(i, f);
                EXPECT_GE(pull(i, f), -1e-12);
                double flow = 0.0;
                for (const AdjacencyGraph* g : {&a, &b}) {
                    for (const Edge& e : g->edges) {
                        if (e.a == i) flow += e.weight * (all(e.a, f) - all(e.b, f));
                        if (e.b == i) flow += e.weight * (all(e.b, f) - all(e.a, f));
                    }
                }
                EXPECT_NEAR(flow, 0.0, 1e-9);
            }
            EXPECT_LT(std::min(std::abs(row), std::abs(row - 1.0)), 1e-9);
            if (seed % 3 == 0 && i == 0) {
                EXPECT_EQ(row, 0.0);
            }
        }
    }
}

TEST(HarmonicPull, Property2OneFixedVertexMovesEverybodyWhole) {
    Random random(9);
    const AdjacencyGraph g = full_graph(random_points(random, 9));
    const dense::Matrix pull = harmonic_pull(g, g, 8);
    for (const double x : pull.values) EXPECT_NEAR(x, 1.0, 1e-12);
}

TEST(SpectralTransition, Property8ObstacleVerticesStandStillAndEndsStay) {
    const int count = tries(15);
    for (int seed = 1; seed <= count; ++seed) {
        SCOPED_TRACE(seed);
        Random random(static_cast<std::uint64_t>(seed));
        const Points a = random_points(random, 16), b = random_points(random, 16), fixed = random_points(random, 3);
        const auto with_fixed = [&](Points drones) {
            Points all = drones;
            all.insert(all.end(), fixed.begin(), fixed.end());
            return SpectralKeyframe{std::move(drones), nearest_graph(all, 5), fixed};
        };
        const SpectralTransition transition = built(with_fixed(a), with_fixed(b));
        EXPECT_LT(largest_distance(positions(transition, 16, 0.0), a), 1e-9);
        EXPECT_LT(largest_distance(positions(transition, 16, 1.0), b), 1e-9);
        // The same individuals with the obstacles as drones: what the shift has to make up for.
        Points all_a = a, all_b = b;
        all_a.insert(all_a.end(), fixed.begin(), fixed.end());
        all_b.insert(all_b.end(), fixed.begin(), fixed.end());
        const SpectralTransition plain = built(keyframe(all_a), keyframe(all_b));
        const Points loose = positions(plain, 19, 0.5);
        double farthest = 0.0;
        for (std::size_t f = 0; f < 3; ++f) farthest = std::max(farthest, glm::distance(loose[16 + f], fixed[f]));
        EXPECT_LE(largest_distance(positions(transition, 16, 0.5), std::span(loose).first(16)), farthest + 1e-9);
    }
}

TEST(SpectralTransition, Property8OneObstacleKeepsItsPlaceInTheFormation) {
    // A ring round a mast turns by a third: everybody stays as far from the mast as before.
    Points from = ring(12, 9.0), to = ring(12, 9.0, 2.0);
    const Vec3 mast{0, 0, 0};
    for (Points* p : {&from, &to}) p->push_back(mast);
    const AdjacencyGraph graph_a = full_graph(from), graph_b = full_graph(to);
    from.pop_back();
    to.pop_back();
    const SpectralTransition transition = built({from, graph_a, {mast}}, {to, graph_b, {mast}});
    for (const double t : {0.2, 0.5, 0.7}) {
        for (const Vec3& p : positions(transition, 12, t)) EXPECT_NEAR(glm::length(p - mast), 9.0, 1e-6);
    }
}

}  // namespace
}  // namespace aerogram::planner
