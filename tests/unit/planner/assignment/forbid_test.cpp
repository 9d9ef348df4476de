#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/planner/assignment/instances.hpp"

namespace aerogram::planner {
namespace {

using namespace testing;
using ::testing::ElementsAre;
using Forbidden = std::set<std::pair<DroneId, SlotId>>;

const Points kRow{{0, 0, 0}, {2, 0, 0}, {4, 0, 0}, {6, 0, 0}};

Result<Assignment> shortest(const Points& from, const Points& to, const MatchRules& rules) {
    return assign_shortest(from, to, rules, kEuclidean, aerogram::Run{});
}
std::string refusal(const Result<Assignment>& result) {
    EXPECT_EQ(result.error().code, ErrorCode::infeasible);
    return result.error().message;
}

double brute_force(const Points& from, const Points& to, const Forbidden& forbid) {
    std::vector<SlotId> slot_of;
    for (std::size_t i = 0; i < from.size(); ++i) slot_of.emplace_back(i);
    double best = 1e18;
    do {
        bool keeps = true;
        for (std::size_t i = 0; i < from.size(); ++i) keeps = keeps && !forbid.contains({DroneId(i), slot_of[i]});
        if (keeps) best = std::min(best, cost_of(from, to, slot_of, kEuclidean));
    } while (std::next_permutation(slot_of.begin(), slot_of.end()));
    return best;
}

TEST(Forbid, ShortestEqualsBruteForceAndRefusesWhatItRefuses) {
    std::size_t feasible = 0, infeasible = 0;
    for (std::uint64_t seed = 1; seed <= 80; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const std::size_t n = 1 + seed % 7;
        const Points from = random_points(n, seed), to = random_points(n, seed + 1000);
        Forbidden forbid;
        for (std::size_t k = 0; k < random.below(n * n); ++k)
            forbid.emplace(DroneId(random.below(n)), SlotId(random.below(n)));
        const double best = brute_force(from, to, forbid);
        const auto found = shortest(from, to, {{}, forbid});
        ASSERT_EQ(found.ok(), best < 1e18);
        (found.ok() ? feasible : infeasible) += 1;
        if (!found) continue;
        EXPECT_TRUE(is_bijection(found->slot_of));
        EXPECT_NEAR(found->cost_m2, best, 1e-9 * best);
        EXPECT_LE(found->duality_gap, 1e-12);
    }
    EXPECT_GT(feasible, 30U);
    EXPECT_GT(infeasible, 5U);
}

// Forbidding what the optimum uses, a few times over: the auction and the augmenting paths agree that it costs more.
TEST(Forbid, LargerInstancesStayCertified) {
    for (const std::size_t n : {40U, 300U, 3100U}) {
        const Points from = sheet(n), to = ball(n);
        const Assignment free = shortest(from, to, {}).value();
        Forbidden forbid;
        for (std::size_t d = 0; d < n; d += 3) forbid.emplace(DroneId(d), free.slot_of[d]);
        const Assignment found = shortest(from, to, {{}, forbid}).value();
        EXPECT_TRUE(is_bijection(found.slot_of));
        for (std::size_t d = 0; d < n; ++d) EXPECT_FALSE(forbid.contains({DroneId(d), found.slot_of[d]}));
        EXPECT_GT(found.cost_m2, free.cost_m2);
        EXPECT_LE(found.duality_gap, n <= 3000 ? 1e-12 : 1e-7);
    }
}

TEST(Forbid, WitnessNamesDronesAndTheirTooFewSlots) {
    Forbidden forbid;
    for (const std::size_t d : {0U, 1U, 3U})
        for (const std::size_t s : {0U, 2U}) forbid.emplace(DroneId(d), SlotId(s));
    EXPECT_EQ(refusal(shortest(kRow, kRow, {{}, forbid})),
              "drones 1, 2 and 4 may take only slots 2 and 4, one too few: forbid fewer pairs");
    EXPECT_EQ(
        refusal(assign_bottleneck(
            kRow, kRow,
            {{}, {{DroneId(2), SlotId(0)}, {DroneId(2), SlotId(1)}, {DroneId(2), SlotId(2)}, {DroneId(2), SlotId(3)}}},
            kEuclidean, aerogram::Run{})),
        "drone 3 may not take any of the slots: forbid fewer pairs");
}

TEST(Forbid, PinnedPairsMayNotBeForbidden) {
    const MatchRules rules{{{DroneId(1), SlotId(3)}}, {{DroneId(1), SlotId(3)}}};
    const std::string message = "drone 2 is pinned to slot 4, which is forbidden to it";
    EXPECT_EQ(refusal(shortest(kRow, kRow, rules)), message);
    EXPECT_EQ(refusal(assign_bottleneck(kRow, kRow, rules, kEuclidean, aerogram::Run{})), message);
}

TEST(Forbid, KeepNamesTheForbiddenPairItWouldUse) {
    EXPECT_EQ(refusal(assign_keep(kRow, kRow, {{}, {{DroneId(2), SlotId(2)}}}, kEuclidean)),
              "drone 3 would fly to slot 3, which is forbidden to it");
    EXPECT_TRUE(assign_keep(kRow, kRow, {{}, {{DroneId(2), SlotId(1)}}}, kEuclidean).ok());
}

TEST(Forbid, GroupsGoWhereTheirDronesMay) {
    const GroupMatch groups{
        {{DroneId(0), DroneId(1)}, {DroneId(2), DroneId(3)}}, {{SlotId(0), SlotId(1)}, {SlotId(2), SlotId(3)}}, {}};
    const auto grouped = [&](const Forbidden& forbid) {
        return assign_groups(kRow, kRow, groups, {{}, forbid}, kEuclidean, aerogram::Run{});
    };
    EXPECT_THAT(numbers(grouped({{DroneId(0), SlotId(0)}}).value().slot_of), ElementsAre(1, 0, 2, 3));
    EXPECT_THAT(numbers(grouped({{DroneId(0), SlotId(0)}, {DroneId(0), SlotId(1)}}).value().slot_of),
                ElementsAre(2, 3, 0, 1));
    EXPECT_EQ(
        refusal(grouped(
            {{DroneId(0), SlotId(0)}, {DroneId(0), SlotId(1)}, {DroneId(0), SlotId(2)}, {DroneId(0), SlotId(3)}})),
        "the forbidden pairs leave 2 groups of 2 drones no way to take the slot sets of that size");
}

TEST(Forbid, SwapsDoNotMakeForbiddenPairs) {
    // The free optimum keeps order; forbidding it leaves a crossing, which is reported.
    const Assignment found =
        shortest({{0, 0, 0}, {2, 0, 0}}, {{0, 5, 0}, {2, 5, 0}}, {{}, {{DroneId(0), SlotId(0)}}}).value();
    EXPECT_THAT(numbers(found.slot_of), ElementsAre(1, 0));
    EXPECT_FALSE(found.pairwise);
    EXPECT_TRUE(found.crossing.has_value());
}

}  // namespace
}  // namespace aerogram::planner
