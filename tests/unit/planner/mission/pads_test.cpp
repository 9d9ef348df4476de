#include "planner/mission/pads.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <iostream>

#include "mission_text.hpp"

namespace aerogram::planner::test {
namespace {

using ::testing::ElementsAre;

TEST(Pads, GridIsRowMajorFromTheAudienceLeftToRight) {
    const Points pads = grid_pads({2, 3, 2.0, {10.0, -20.0}}, 6);
    EXPECT_THAT(pads, ElementsAre(Vec3(8, -21, 0), Vec3(10, -21, 0), Vec3(12, -21, 0), Vec3(8, -19, 0),
                                  Vec3(10, -19, 0), Vec3(12, -19, 0)));
}

TEST(Pads, MorePadsThanDronesUsesTheFirst) {
    const auto m = parse(kShow + "[fleet]\ndrones = 4\npads = { rows = 5, columns = 3, spacing_m = 3 }\n" + kKeyframe);
    ASSERT_TRUE(m.ok()) << message(m);
    EXPECT_EQ(m->fleet.pads_m, grid_pads({5, 3, 3.0, {}}, 4));
}

TEST(Pads, SeparationIsMeasuredInTheMetric) {
    const Points stacked{{0, 0, 0}, {0, 0, 3}};
    EXPECT_FALSE(find_tight_pads(stacked, {1.0}, 1.55));
    const auto tight = find_tight_pads(stacked, {2.0}, 1.55);
    ASSERT_TRUE(tight);
    EXPECT_EQ(tight->distance_m, 1.5);
}

// Oracle: all pairs.
TEST(Pads, TightestPairIsThatOfAllPairs) {
    constexpr std::uint64_t kSeed = 20090801;
    std::cout << "seed " << kSeed << '\n';
    std::uint64_t state = kSeed;
    const auto random = [&](double size) {  // splitmix64
        std::uint64_t z = (state += 0x9E3779B97F4A7C15ULL);
        z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
        z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
        return size * static_cast<double>((z ^ (z >> 31U)) >> 11U) / 9007199254740992.0 - size / 2.0;
    };
    std::size_t found = 0;
    for (int round = 0; round < 2000; ++round) {
        Points pads;
        const double size = 2.0 + round % 40;
        for (int i = 0; i < 2 + round % 29; ++i) pads.emplace_back(random(size), random(size), random(1.0));
        const SeparationMetric metric{1.0 + round % 3};
        double least = 1.55;
        for (std::size_t i = 0; i < pads.size(); ++i) {
            for (std::size_t j = i + 1; j < pads.size(); ++j)
                least = std::min(least, metric.distance(pads[i], pads[j]));
        }
        const auto tight = find_tight_pads(pads, metric, 1.55);
        ASSERT_EQ(tight.has_value(), least < 1.55) << "round " << round;
        if (!tight) continue;
        ++found;
        EXPECT_EQ(tight->distance_m, least) << "round " << round;
        EXPECT_EQ(metric.distance(pads[tight->first], pads[tight->second]), least);
        EXPECT_LT(tight->first, tight->second);
    }
    EXPECT_GT(found, 100U);
    EXPECT_LT(found, 2000U);
}

TEST(Pads, ManyPadsAtOnePlaceAreFoundAtOnce) {
    const auto tight = find_tight_pads(Points(100000, Vec3(1, 2, 0)), {1.0}, 100.0);
    ASSERT_TRUE(tight);
    EXPECT_EQ(tight->distance_m, 0.0);
}

TEST(Pads, GridAtExactlyTheSeparationIsNotTight) {
    const auto m = parse(kShow +
                         "[fleet]\ndrones = 100\npads = { rows = 10, columns = 10, spacing_m = 1.55, center_m = "
                         "[0.1, -7.3] }\n" +
                         kKeyframe);
    EXPECT_TRUE(m.ok()) << message(m);
}

}  // namespace
}  // namespace aerogram::planner::test
