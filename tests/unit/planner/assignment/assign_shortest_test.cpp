#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "geo/contract.hpp"
#include "tests/unit/planner/assignment/instances.hpp"

namespace aerogram::planner {
namespace {

using namespace testing;
using ::testing::ElementsAre;

Assignment shortest(const Points& from, const Points& to, const SeparationMetric& metric = kEuclidean,
                    const std::map<DroneId, SlotId>& pins = {}) {
    return assign_shortest(from, to, pins, metric, aerogram::Run{}).value();
}

TEST(AssignShortest, NoneOneTwoThree) {
    EXPECT_TRUE(shortest({}, {}).pairwise);
    EXPECT_THAT(numbers(shortest({{0, 0, 0}}, {{3, 4, 0}}).slot_of), ElementsAre(0));
    EXPECT_DOUBLE_EQ(shortest({{0, 0, 0}}, {{3, 4, 0}}).cost_m2, 25.0);
    EXPECT_THAT(numbers(shortest({{0, 0, 0}, {5, 0, 0}}, {{5, 0, 9}, {0, 0, 9}}).slot_of), ElementsAre(1, 0));
    EXPECT_THAT(numbers(shortest({{0, 0, 0}, {2, 0, 0}, {4, 0, 0}}, {{9, 0, 0}, {5, 0, 0}, {7, 0, 0}}).slot_of),
                ElementsAre(1, 2, 0));
}

TEST(AssignShortest, EqualsBruteForceUpToEight) {
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        SCOPED_TRACE(seed);
        const std::size_t n = 1 + seed % 8;
        const SeparationMetric metric{seed % 2 == 0 ? 1.0 : 2.5};
        const Points from = random_points(n, seed), to = random_points(n, seed + 1000);
        const Assignment found = shortest(from, to, metric);
        const double best = brute_force_cost(from, to, metric);
        EXPECT_TRUE(is_bijection(found.slot_of));
        EXPECT_NEAR(found.cost_m2, best, 1e-12 * best);
        EXPECT_NEAR(found.cost_m2, cost_of(from, to, found.slot_of, metric), 1e-12 * best);
        EXPECT_TRUE(found.pairwise);
    }
}

// The gap is proven by the dual, which the test of duality_gap_m2 checks on its own.
TEST(AssignShortest, ClosesTheGapOnRandomAndStructuredInstances) {
    for (const std::size_t n : {31U, 32U, 40U, 100U, 300U}) {
        const Motion tilt{{0.5, 0.2, 0.1}, {5, 5, 40}};
        const std::vector<std::pair<Points, Points>> instances{
            {random_points(n, 1, 20.0), random_points(n, 2, 20.0)},
            {pads(n), letters(n)},
            {sheet(n), ball(n)},
            {sheet(n), tilt(circle(n, 0.4 * static_cast<double>(n)))},
            {letters(n), Motion{{0, 0.7, 0}, {}}(letters(n))}};
        for (const auto& [from, to] : instances) {
            const Assignment found = shortest(from, to);
            EXPECT_TRUE(is_bijection(found.slot_of));
            EXPECT_GE(found.duality_gap, 0.0);
            EXPECT_LE(found.duality_gap, 1e-12) << n;
            EXPECT_TRUE(found.pairwise);
            EXPECT_FALSE(found.crossing.has_value());
        }
    }
}

TEST(AssignShortest, ThousandDronesFromPadsToLetters) {
    const Assignment found = shortest(pads(1000), letters(1000));
    EXPECT_TRUE(is_bijection(found.slot_of));
    EXPECT_LE(found.duality_gap, 1e-12);
    EXPECT_TRUE(found.pairwise);
}

TEST(AssignShortest, MoreThanAugmentingIsGoodForIsStillCertified) {
    const Assignment found = shortest(sheet(3100), Motion{{0.5, 0.2, 0.1}, {5, 5, 40}}(sheet(3100)));
    EXPECT_TRUE(is_bijection(found.slot_of));
    EXPECT_LE(found.duality_gap, 1e-7);
    EXPECT_TRUE(found.pairwise);
}

TEST(AssignShortest, TranslationIsRecovered) {
    for (const std::size_t n : {5U, 60U, 300U}) {
        const Points from = random_points(n, n, 20.0);
        Points to;
        for (const Vec3& p : from) to.push_back(p + Vec3{100, -30, 55});
        const Assignment found = shortest(from, to);
        for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(found.slot_of[i], SlotId(i));
        EXPECT_NEAR(found.cost_m2, static_cast<double>(n) * 13925.0, 1e-8);
    }
}

// On a line the sorted order is the optimum: closed form.
TEST(AssignShortest, LinesAreMatchedInOrder) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        Points from = random_points(50, seed), to = random_points(50, seed + 77);
        for (Vec3& p : from) p = Vec3{p.x, 0, 0};
        for (Vec3& p : to) p = Vec3{3.0 * p.x, 0, 40};
        const Assignment found = shortest(from, to);
        for (std::size_t i = 0; i < 50; ++i)
            for (std::size_t j = 0; j < 50; ++j) {
                if (from[i].x < from[j].x) {
                    EXPECT_LT(to[found.slot_of[i].value].x, to[found.slot_of[j].value].x);
                }
            }
    }
}

TEST(AssignShortest, DownwashChangesWhoIsNear) {
    const Points from{{0, 0, 0}, {0, 0, 5}}, to{{3, 0, 5}, {-3, 0, 0}};
    const Points sideways{{0, 0, 0}, {4, 0, 3}}, upward{{4.5, 0, 0.5}, {0.5, 0, 2.5}};
    EXPECT_THAT(numbers(shortest(from, to).slot_of), ElementsAre(1, 0));
    for (const double downwash : {1.0, 5.0}) {
        const SeparationMetric metric{downwash};
        const Assignment found = shortest(sideways, upward, metric);
        EXPECT_NEAR(found.cost_m2, brute_force_cost(sideways, upward, metric), 1e-12);
    }
    // Crosswise: 2 (1 + 9 / d²); straight: 2 · 16. Euclidean takes 20 < 32; both agree for every d >= 1.
    const Points low{{0, 0, 0}, {4, 0, 0}}, high{{3, 0, 4}, {1, 0, -4}};
    EXPECT_DOUBLE_EQ(shortest(low, high, SeparationMetric{2.0}).cost_m2, 1.0 + 1.0 + 2.0 * 4.0);
}

TEST(AssignShortest, TiesGoToTheLowerIndex) {
    // A row under a column: every assignment costs the same.
    Points row, column;
    for (int k = 0; k < 40; ++k) {
        row.emplace_back(k, 0, 0);
        column.emplace_back(0, 0, k);
    }
    const Assignment found = shortest(row, column);
    for (std::size_t i = 0; i < 40; ++i) EXPECT_EQ(found.slot_of[i], SlotId(i));
}

TEST(AssignShortest, CoincidentDronesAndSlotsAreAssignedByIndex) {
    const Points from(50, {1, 2, 3});
    EXPECT_TRUE(std::ranges::is_sorted(shortest(from, from).slot_of));
    EXPECT_TRUE(std::ranges::is_sorted(shortest(from, random_points(50, 4)).slot_of));
    Points halves(60, {0, 0, 0});
    for (std::size_t i = 0; i < 30; ++i) halves[i].x = 9.0;
    const Assignment found = shortest(halves, sheet(60));
    EXPECT_TRUE(is_bijection(found.slot_of));
    EXPECT_LE(found.duality_gap, 1e-12);
    EXPECT_TRUE(std::is_sorted(found.slot_of.begin(), found.slot_of.begin() + 30));
    EXPECT_TRUE(std::is_sorted(found.slot_of.begin() + 30, found.slot_of.end()));
}

TEST(AssignShortest, IdenticalFormationsStayPut) {
    const Assignment found = shortest(sheet(120), sheet(120));
    for (std::size_t i = 0; i < 120; ++i) EXPECT_EQ(found.slot_of[i], SlotId(i));
    EXPECT_EQ(found.cost_m2, 0.0);
    EXPECT_LE(found.duality_gap, 1e-12);
}

TEST(AssignShortest, PermutingDronesPermutesTheResult) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        const Points from = random_points(70, seed), to = random_points(70, seed + 50), mixed = shuffled(from, seed);
        const Assignment straight = shortest(from, to), permuted = shortest(mixed, to);
        for (std::size_t i = 0; i < 70; ++i) {
            const auto at = static_cast<std::size_t>(std::find(mixed.begin(), mixed.end(), from[i]) - mixed.begin());
            EXPECT_EQ(permuted.slot_of[at], straight.slot_of[i]) << seed;
        }
    }
}

TEST(AssignShortest, SameInputGivesTheSameBits) {
    const Assignment first = shortest(pads(200), letters(200)), second = shortest(pads(200), letters(200));
    EXPECT_EQ(first.slot_of, second.slot_of);
    EXPECT_EQ(first.cost_m2, second.cost_m2);
    EXPECT_EQ(first.duality_gap, second.duality_gap);
}

TEST(AssignShortest, PinsStayAndTheRestIsTheBestOfWhatIsLeft) {
    const Points from = random_points(7, 3), to = random_points(7, 4);
    const Assignment found = shortest(from, to, kEuclidean, {{DroneId(2), SlotId(5)}, {DroneId(0), SlotId(1)}});
    EXPECT_EQ(found.slot_of[2], SlotId(5));
    EXPECT_EQ(found.slot_of[0], SlotId(1));
    const double rest = brute_force_cost({from[1], from[3], from[4], from[5], from[6]},
                                         {to[0], to[2], to[3], to[4], to[6]}, kEuclidean);
    const double pinned = std::pow(glm::length(from[2] - to[5]), 2) + std::pow(glm::length(from[0] - to[1]), 2);
    EXPECT_NEAR(found.cost_m2, rest + pinned, 1e-10);
}

TEST(AssignShortest, PinsThatCrossAreReportedNotMoved) {
    const Points row{{0, 0, 0}, {2, 0, 0}, {4, 0, 0}};
    const Assignment found = shortest(row, row, kEuclidean, {{DroneId(0), SlotId(2)}, {DroneId(2), SlotId(0)}});
    EXPECT_THAT(numbers(found.slot_of), ElementsAre(2, 1, 0));
    EXPECT_FALSE(found.pairwise);
    ASSERT_TRUE(found.crossing.has_value());
    EXPECT_EQ(found.crossing->first, DroneId(0));
    EXPECT_EQ(found.crossing->second, DroneId(1));
}

TEST(AssignShortest, MatchedFormationsKeepSpacingOverRootTwo) {
    const std::vector<std::pair<Points, Points>> shows{{pads(60), letters(60)},
                                                       {sheet(60), ball(60)},
                                                       {letters(60), ball(60)},
                                                       {ball(100), Motion{{1.0, 2.0, 0.3}, {}}(ball(100))}};
    for (const auto& [from, to] : shows) {
        const Assignment found = shortest(from, to);
        double spacing = 1e9, closest = 1e9;
        for (std::size_t i = 0; i < from.size(); ++i)
            for (std::size_t j = 0; j < i; ++j) {
                spacing = std::min({spacing, glm::length(from[i] - from[j]), glm::length(to[i] - to[j])});
                const Vec3 w = from[i] - from[j], u = to[found.slot_of[i].value] - to[found.slot_of[j].value];
                for (int k = 0; k <= 200; ++k) closest = std::min(closest, glm::length(w + (u - w) * (k / 200.0)));
            }
        EXPECT_GE(closest, spacing / std::sqrt(2.0) - 1e-6);
    }
}

TEST(AssignShortest, StopsWhenAsked) {
    std::stop_source source;
    source.request_stop();
    aerogram::Run run;
    run.stop = source.get_token();
    for (const std::size_t n : {8U, 500U}) {
        const auto result = assign_shortest(random_points(n, 1), random_points(n, 2), {}, kEuclidean, run);
        ASSERT_FALSE(result.ok());
        EXPECT_EQ(result.error().code, ErrorCode::stopped);
    }
}

TEST(AssignShortest, ReportsProgressThatNeverFallsBack) {
    std::vector<double> shares;
    aerogram::Run run;
    run.progress = [&](std::string_view stage, double share) {
        EXPECT_EQ(stage, "assign");
        shares.push_back(share);
    };
    ASSERT_TRUE(assign_shortest(pads(100), letters(100), {}, kEuclidean, run).ok());
    ASSERT_GT(shares.size(), 3U);
    EXPECT_TRUE(std::ranges::is_sorted(shares));
    EXPECT_GE(shares.front(), 0.0);
    EXPECT_LE(shares.back(), 1.0);
}

TEST(AssignShortest, BrokenCallsAreBugs) {
    const Points two{{0, 0, 0}, {1, 0, 0}}, three{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    EXPECT_THROW((void)shortest(two, three), ContractViolation);
    EXPECT_THROW((void)shortest({{0, 0, std::numeric_limits<double>::quiet_NaN()}}, {{0, 0, 0}}), ContractViolation);
    EXPECT_THROW((void)shortest(two, two, kEuclidean, {{DroneId(0), SlotId(1)}, {DroneId(1), SlotId(1)}}),
                 ContractViolation);
    EXPECT_THROW((void)shortest(two, two, kEuclidean, {{DroneId(0), SlotId(2)}}), ContractViolation);
}

}  // namespace
}  // namespace aerogram::planner
