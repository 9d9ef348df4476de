#include "planner/sketch/correspondences.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <set>

#include "tests/unit/planner/sketch/strokes.hpp"

namespace aerogram::planner {
namespace {

using namespace testing;

std::vector<FormationCoordinate> random_coordinates(std::size_t n, std::uint64_t seed, double steps) {
    Random random(seed);
    std::vector<FormationCoordinate> out(n);
    for (FormationCoordinate& c : out)  // on a coarse lattice, so that there are ties
        for (double& value : c) value = std::floor(random.between(0.0, steps));
    return out;
}

double squared(const FormationCoordinate& a, const FormationCoordinate& b) {
    double sum = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
    return sum;
}

/// Brute force: the nearest that is free, the lowest index of equals.
std::uint32_t nearest_of(const std::vector<FormationCoordinate>& all, const std::vector<bool>& gone,
                         const FormationCoordinate& to, const std::vector<std::uint32_t>& except = {}) {
    std::uint32_t best = kNobody;
    for (std::uint32_t i = 0; i < all.size(); ++i) {
        if (gone[i] || std::find(except.begin(), except.end(), i) != except.end()) continue;
        if (best == kNobody || squared(all[i], to) < squared(all[best], to)) best = i;
    }
    return best;
}

TEST(CoordinateTree, FindsTheNearestThatIsLeftAsBruteForceDoes) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const std::size_t n = 1 + 17 * seed;
        const auto points = random_coordinates(n, seed, 6.0), asked = random_coordinates(n, seed + 100, 7.0);
        CoordinateTree tree(points);
        std::vector<bool> gone(n, false);
        for (std::size_t k = 0; k < n; ++k) {
            EXPECT_EQ(tree.size(), n - k);
            const std::uint32_t found = tree.nearest(asked[k]);
            ASSERT_EQ(found, nearest_of(points, gone, asked[k])) << seed << ' ' << k;
            const std::vector<std::uint32_t> except{found};
            EXPECT_EQ(tree.nearest(asked[k], except), nearest_of(points, gone, asked[k], except));
            tree.remove(found);
            gone[found] = true;
        }
        EXPECT_EQ(tree.nearest(asked[0]), kNobody);
    }
}

TEST(CoordinateTree, WithinFindsAllThatAreLeft) {
    const auto points = random_coordinates(300, 4, 6.0);
    CoordinateTree tree(points);
    for (std::uint32_t i = 0; i < 300; i += 3) tree.remove(i);
    std::set<std::uint32_t> found, wanted;
    tree.within(points[0], 2.5, [&](std::uint32_t i, double d2) {
        EXPECT_EQ(d2, squared(points[i], points[0]));
        found.insert(i);
    });
    for (std::uint32_t i = 0; i < 300; ++i)
        if (i % 3 != 0 && squared(points[i], points[0]) <= 6.25) wanted.insert(i);
    EXPECT_FALSE(wanted.empty());
    EXPECT_EQ(found, wanted);
}

TEST(Correspondences, Property1And2_BoundaryFirstThenTheNearestFreePoint) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        const auto agents = random_coordinates(120, seed, 9.0), points = random_coordinates(150, seed + 50, 9.0);
        const std::size_t boundary = 40;
        const auto found = find_correspondences(agents, points, boundary);
        std::vector<bool> busy(agents.size(), false), taken(points.size(), false);
        std::vector<std::uint32_t> wanted(agents.size(), kNobody);
        for (std::uint32_t p = 0; p < boundary; ++p) {
            const std::uint32_t agent = nearest_of(agents, busy, points[p]);
            wanted[agent] = p;
            busy[agent] = taken[p] = true;
        }
        for (std::uint32_t a = 0; a < agents.size(); ++a) {
            if (busy[a]) continue;
            wanted[a] = nearest_of(points, taken, agents[a]);
            taken[wanted[a]] = true;
        }
        EXPECT_EQ(found, wanted) << seed;
        EXPECT_EQ(std::set<std::uint32_t>(found.begin(), found.end()).size(), agents.size());
        for (std::uint32_t p = 0; p < boundary; ++p) EXPECT_EQ(std::count(found.begin(), found.end(), p), 1);
    }
}

TEST(Correspondences, Property3_RulesAreKept) {
    const auto agents = random_coordinates(60, 3, 9.0);
    CorrespondenceRules rules;
    rules.forbidden_points.resize(60);
    rules.forbidden_agents.resize(60);
    rules.taken_point_of.assign(60, kNobody);
    for (std::uint32_t a = 0; a < 60; ++a) {
        rules.forbidden_points[a].push_back(a);
        rules.forbidden_agents[a].push_back(a);
    }
    rules.taken_point_of[5] = 17;
    rules.taken_point_of[9] = kElsewhere;
    const auto found = find_correspondences(agents, agents, 20, rules);
    EXPECT_EQ(found[5], 17U);
    EXPECT_EQ(found[9], kNobody);
    for (std::uint32_t a = 0; a < 60; ++a) EXPECT_NE(found[a], a);
}

TEST(Correspondences, AFormationThatOnlyMovedAndGrewKeepsEverybodyInPlace) {
    const auto from = scattered(200, 11);
    auto to = from;
    for (Vec2& p : to) p = 2.5 * p + Vec2(100, 30);
    const auto found =
        find_correspondences(coordinates_in(plane_frame(from), from), coordinates_in(plane_frame(to), to), 50);
    for (std::uint32_t a = 0; a < found.size(); ++a) EXPECT_EQ(found[a], a);
}

}  // namespace
}  // namespace aerogram::planner
