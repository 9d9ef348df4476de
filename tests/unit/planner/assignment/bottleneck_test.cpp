#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/assignment/maximum_matching.hpp"
#include "tests/unit/planner/assignment/instances.hpp"

namespace aerogram::planner {
namespace {

using namespace testing;
using ::testing::ElementsAre;

/// The least longest flight (true metres), and the least squared cost (separation metric) among those that have it.
struct Best {
    double longest_m = 1e9, cost_m2 = 1e9;
};
Best brute_force(const Points& from, const Points& to, const MatchRules& rules, const SeparationMetric& metric) {
    std::vector<SlotId> slot_of;
    for (std::size_t i = 0; i < from.size(); ++i) slot_of.emplace_back(i);
    Best best;
    do {
        double longest_m = 0.0;
        bool keeps = true;
        for (std::size_t i = 0; i < from.size(); ++i) {
            longest_m = std::max(longest_m, glm::length(from[i] - to[slot_of[i].value]));
            const auto pin = rules.pins.find(DroneId(i));
            keeps = keeps && !rules.forbid.contains({DroneId(i), slot_of[i]}) &&
                    (pin == rules.pins.end() || pin->second == slot_of[i]);
        }
        if (!keeps || longest_m > best.longest_m + 1e-9) continue;
        const double cost_m2 = cost_of(from, to, slot_of, metric);
        if (longest_m < best.longest_m - 1e-9 || cost_m2 < best.cost_m2) best = {longest_m, cost_m2};
    } while (std::next_permutation(slot_of.begin(), slot_of.end()));
    return best;
}

Result<Assignment> bottleneck(const Points& from, const Points& to, const MatchRules& rules = {},
                              const SeparationMetric& metric = kEuclidean) {
    return assign_bottleneck(from, to, rules, metric, aerogram::Run{});
}

TEST(AssignBottleneck, Property1To3_EqualsBruteForceWithPinsAndForbiddenPairs) {
    std::size_t feasible = 0, infeasible = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const std::size_t n = 2 + seed % 6;
        const Points from = random_points(n, seed), to = random_points(n, seed + 1000);
        const SeparationMetric metric{seed % 3 == 0 ? 2.5 : 1.0};
        MatchRules rules;
        if (seed % 2 == 0) rules.pins = {{DroneId(random.below(n)), SlotId(random.below(n))}};
        for (std::size_t k = 0; k < seed % 9; ++k)
            rules.forbid.emplace(DroneId(random.below(n)), SlotId(random.below(n)));
        const Best best = brute_force(from, to, rules, metric);
        const auto found = bottleneck(from, to, rules, metric);
        ASSERT_EQ(found.ok(), best.cost_m2 < 1e9);
        (found.ok() ? feasible : infeasible) += 1;
        if (!found) continue;
        EXPECT_TRUE(is_bijection(found->slot_of));
        EXPECT_TRUE(found->longest_is_least);
        EXPECT_NEAR(found->longest_m, best.longest_m, 1e-12 * best.longest_m);
        EXPECT_NEAR(found->cost_m2, best.cost_m2, 1e-9 * best.cost_m2);
    }
    EXPECT_GT(feasible, 30U);
    EXPECT_GT(infeasible, 2U);
}

TEST(AssignBottleneck, Property2_NothingShorterMatchesAndTheSquaredOptimumIsNoShorter) {
    for (const std::size_t n : {40U, 300U}) {
        const Motion tilt{{0.5, 0.2, 0.1}, {5, 5, 40}};
        for (const auto& [from, to] : {std::pair(random_points(n, 1, 20.0), random_points(n, 2, 20.0)),
                                       {pads(n), letters(n)},
                                       {sheet(n), tilt(circle(n, 0.4 * static_cast<double>(n)))}}) {
            const Assignment found = bottleneck(from, to).value();
            const Assignment squared = assign_shortest(from, to, {}, kEuclidean, aerogram::Run{}).value();
            EXPECT_TRUE(is_bijection(found.slot_of));
            EXPECT_LE(found.longest_m, squared.longest_m);
            EXPECT_GE(found.cost_m2, squared.cost_m2 * (1.0 - 1e-12));
            EXPECT_LE(found.duality_gap, 1e-11);
            const Coordinates x = centred(from, kEuclidean);
            Coordinates y(n);
            Vec3 origin{};
            for (const Vec3& p : from) origin += p / static_cast<double>(n);
            for (std::size_t j = 0; j < n; ++j) y.set(j, to[j] - origin);
            Allowed shorter;
            shorter.reach2_m2 = found.longest_m * found.longest_m * (1.0 - 1e-9);
            const auto none = maximum_matching(x, y, shorter, {}, aerogram::Run{});
            ASSERT_TRUE(none);
            EXPECT_FALSE(none->is_complete());
            EXPECT_EQ(none->stuck_bidders.size(), none->their_targets.size() + 1);
        }
    }
}

TEST(AssignBottleneck, TheLongestOfALineIsShortestInOrderAndSquaredCostBreaksTies) {
    // One drone far out sets the length; the others then fly as short as they can.
    const Points from{{0, 0, 0}, {2, 0, 0}, {100, 0, 0}}, to{{2, 5, 0}, {0, 5, 0}, {60, 5, 0}};
    const Assignment found = bottleneck(from, to).value();
    EXPECT_THAT(numbers(found.slot_of), ElementsAre(1, 0, 2));
    EXPECT_DOUBLE_EQ(found.longest_m, std::sqrt(1600.0 + 25.0));
}

TEST(AssignBottleneck, NoneOneAndCoincidentDrones) {
    EXPECT_TRUE(bottleneck({}, {}).value().slot_of.empty());
    EXPECT_DOUBLE_EQ(bottleneck({{0, 0, 0}}, {{3, 4, 0}}).value().longest_m, 5.0);
    EXPECT_EQ(bottleneck(sheet(50), sheet(50)).value().longest_m, 0.0);
    EXPECT_TRUE(is_bijection(bottleneck(Points(50, {1, 2, 3}), sheet(50)).value().slot_of));
}

TEST(AssignBottleneck, APinnedFlightLongerThanTheRestNeedsSetsTheLength) {
    const Points from{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, to{{0, 1, 0}, {1, 1, 0}, {2, 50, 0}};
    const Assignment found = bottleneck(from, to, {{{DroneId(0), SlotId(2)}}}).value();
    EXPECT_THAT(numbers(found.slot_of), ElementsAre(2, 0, 1));
    EXPECT_DOUBLE_EQ(found.longest_m, std::sqrt(4.0 + 2500.0));
}

TEST(AssignBottleneck, Property4_SameInputGivesTheSameBits) {
    const Assignment first = bottleneck(pads(120), letters(120)).value(),
                     second = bottleneck(pads(120), letters(120)).value();
    EXPECT_EQ(first.slot_of, second.slot_of);
    EXPECT_EQ(first.duality_gap, second.duality_gap);
}

TEST(AssignBottleneck, StopsWhenAskedAndReportsProgressThatNeverFallsBack) {
    std::stop_source source;
    source.request_stop();
    aerogram::Run stopped;
    stopped.stop = source.get_token();
    EXPECT_EQ(assign_bottleneck(pads(200), letters(200), {}, kEuclidean, stopped).error().code, ErrorCode::stopped);
    std::vector<double> shares;
    aerogram::Run run;
    run.progress = [&](std::string_view, double share) { shares.push_back(share); };
    ASSERT_TRUE(assign_bottleneck(pads(200), letters(200), {}, kEuclidean, run).ok());
    ASSERT_GT(shares.size(), 3U);
    EXPECT_TRUE(std::ranges::is_sorted(shares));
    EXPECT_LE(shares.back(), 1.0);
}

}  // namespace
}  // namespace aerogram::planner
