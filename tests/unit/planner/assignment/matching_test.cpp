#include "planner/assignment/matching.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "planner/assignment/price_leaves.hpp"
#include "tests/unit/planner/assignment/instances.hpp"

namespace aerogram::planner {
namespace {

using namespace testing;

double squared_cost(const Coordinates& x, const Coordinates& y, const Matching& m) {
    double cost = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) cost += glm::dot(x[i] - y[m.target_of[i]], x[i] - y[m.target_of[i]]);
    return cost;
}

TEST(PriceLeaves, FindTheBestTwoOfAFullScanWhilePricesRise) {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        Points points = random_points(2 + 60 * seed, seed);
        if (seed % 3 == 0)
            for (Vec3& p : points) p.y = 0.0;
        const Coordinates targets = centred(points, kEuclidean);
        PriceLeaves leaves(targets);
        for (int bid = 0; bid < 2000; ++bid) {
            const Vec3 x = random.in_box(15.0);
            double best = -std::numeric_limits<double>::infinity(), second = best;
            for (std::uint32_t k = 0; k < targets.size(); ++k) {
                const double value = 2.0 * glm::dot(x, targets[leaves.index_at(k)]) - leaves.price(k);
                second = std::max(second, std::min(best, value));
                best = std::max(best, value);
            }
            const auto offer = leaves.best(x, static_cast<std::uint32_t>(random.bits() % targets.size()));
            ASSERT_NEAR(offer.value, best, 1e-10);
            ASSERT_NEAR(offer.second, second, 1e-10);
            leaves.raise(offer.place, leaves.price(offer.place) + offer.value - offer.second + random.in(0.0, 1.0));
        }
    }
}

TEST(Matching, AugmentEqualsBruteForce) {
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        const Points from = random_points(1 + seed % 7, seed), to = random_points(1 + seed % 7, seed + 500);
        const Coordinates x = centred(from, kEuclidean), y = centred(to, kEuclidean);
        const Matching found = augment(x, y, {}, aerogram::Run{}).value();
        std::vector<SlotId> slot_of;
        for (const std::uint32_t t : found.target_of) slot_of.emplace_back(t);
        EXPECT_NEAR(cost_of(from, to, slot_of, kEuclidean), brute_force_cost(from, to, kEuclidean), 1e-9) << seed;
    }
}

TEST(Matching, GapBoundsTheCostOfEveryMatching) {
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        SCOPED_TRACE(seed);
        const Points from = random_points(6, seed), to = random_points(6, seed + 500);
        const Coordinates x = centred(from, kEuclidean), y = centred(to, kEuclidean);
        Random random(seed);
        Matching any{{0, 1, 2, 3, 4, 5}, {}};
        for (int j = 0; j < 6; ++j) any.price.push_back(random.in(-50.0, 50.0));
        const double best = squared_cost(x, y, augment(x, y, {}, aerogram::Run{}).value());
        EXPECT_LE(squared_cost(x, y, any) - duality_gap_m2(x, y, any), best + 1e-9);
    }
}

TEST(Matching, AuctionIsWithinItsEpsilonAndAugmentClosesTheRest) {
    for (const std::size_t n : {2U, 33U, 64U, 200U}) {
        const Coordinates x = centred(pads(n), kEuclidean), y = centred(letters(n), kEuclidean);
        const double epsilon = 1e-3 * radius_of(x) * radius_of(y);
        const Matching coarse = auction(x, y, {epsilon}, aerogram::Run{}).value();
        const double gap = duality_gap_m2(x, y, coarse);
        EXPECT_GE(gap, 0.0);
        EXPECT_LE(gap, static_cast<double>(n) * epsilon * (1.0 + 1e-9));
        const Matching exact = augment(x, y, coarse, aerogram::Run{}).value(),
                       scratch = augment(x, y, {}, aerogram::Run{}).value();
        EXPECT_LE(duality_gap_m2(x, y, exact), 1e-12 * squared_cost(x, y, exact));
        EXPECT_NEAR(squared_cost(x, y, exact), squared_cost(x, y, scratch), 1e-12 * squared_cost(x, y, exact));
        EXPECT_LE(squared_cost(x, y, exact), squared_cost(x, y, coarse) * (1.0 + 1e-12));
    }
}

TEST(KdOrder, IsAPermutation) {
    std::vector<std::uint32_t> order = kd_order(centred(random_points(777, 1), kEuclidean));
    std::sort(order.begin(), order.end());
    for (std::uint32_t i = 0; i < 777; ++i) EXPECT_EQ(order[i], i);
}

}  // namespace
}  // namespace aerogram::planner
