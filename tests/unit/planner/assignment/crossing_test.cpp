#include "planner/assignment/crossing.hpp"

#include <gtest/gtest.h>

#include "tests/unit/planner/assignment/instances.hpp"

namespace aerogram::planner {
namespace {

using namespace testing;

std::vector<SlotId> identity(std::size_t n) {
    std::vector<SlotId> slot_of;
    for (std::size_t i = 0; i < n; ++i) slot_of.emplace_back(i);
    return slot_of;
}

std::optional<CrossingPair> brute_force(const Points& from, const Points& to, const std::vector<SlotId>& slot_of,
                                        const SeparationMetric& metric) {
    for (std::size_t i = 0; i < from.size(); ++i)
        for (std::size_t j = i + 1; j < from.size(); ++j)
            if (glm::dot(metric.scaled(from[i] - from[j]), metric.scaled(to[slot_of[i].value] - to[slot_of[j].value])) <
                -1e-9)
                return CrossingPair{DroneId(i), DroneId(j)};
    return std::nullopt;
}

TEST(FindCrossing, NamesTheFirstPairOfABruteForceSearch) {
    std::size_t with = 0, without = 0;
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const std::size_t n = 2 + seed % 300;
        Points from = random_points(n, seed), to = from;
        const double wander = random.in(0.0, 4.0);
        for (Vec3& p : to) p = p + random.in_box(wander);
        const SeparationMetric metric{1.0 + static_cast<double>(seed % 3)};
        const auto expected = brute_force(from, to, identity(n), metric),
                   found = find_crossing(from, to, identity(n), metric);
        ASSERT_EQ(found.has_value(), expected.has_value());
        (found ? with : without) += 1;
        if (!found) continue;
        EXPECT_EQ(found->first, expected->first);
        EXPECT_EQ(found->second, expected->second);
    }
    EXPECT_GT(with, 20U);
    EXPECT_GT(without, 20U);
}

TEST(FindCrossing, RightAnglesDoNotCross) {
    const Points from{{0, 0, 0}, {2, 0, 0}}, to{{0, 0, 0}, {0, 2, 0}};
    EXPECT_FALSE(find_crossing(from, to, identity(2), kEuclidean));
}

TEST(FindCrossing, DownwashDecides) {
    const Points from{{0, 0, 0}, {1, 0, 3}}, to{{1, 0, 0}, {0, 0, 0.5}};  // -1 + 1.5 / d²
    EXPECT_FALSE(find_crossing(from, to, identity(2), SeparationMetric{1.0}));
    EXPECT_TRUE(find_crossing(from, to, identity(2), SeparationMetric{2.0}));
}

TEST(FindCrossing, NobodyAndOneNeverCross) {
    EXPECT_FALSE(find_crossing({}, {}, {}, kEuclidean));
    EXPECT_FALSE(find_crossing(Points{{1, 1, 1}}, Points{{2, 2, 2}}, identity(1), kEuclidean));
}

TEST(Uncross, RandomAssignmentsEndWithoutCrossingsAndCheaper) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const Points from = random_points(120, seed), to = random_points(120, seed + 99);
        std::vector<SlotId> slot_of = identity(120);
        const double before = cost_of(from, to, slot_of, kEuclidean);
        ASSERT_TRUE(uncross(from, to, slot_of, kEuclidean, aerogram::Run{}));
        EXPECT_TRUE(is_bijection(slot_of));
        EXPECT_FALSE(find_crossing(from, to, slot_of, kEuclidean)) << seed;
        EXPECT_LT(cost_of(from, to, slot_of, kEuclidean), before);
    }
}

TEST(Uncross, PairsThatTieAreSorted) {
    const Points from{{0, 0, 0}, {2, 0, 0}, {4, 0, 0}}, to{{0, 2, 0}, {0, 4, 0}, {0, 6, 0}};
    std::vector<SlotId> slot_of{SlotId(2), SlotId(0), SlotId(1)};
    ASSERT_TRUE(uncross(from, to, slot_of, kEuclidean, aerogram::Run{}));
    EXPECT_EQ(slot_of, identity(3));
}

}  // namespace
}  // namespace aerogram::planner
