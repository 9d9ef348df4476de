#include "export/picture/spacing_histogram.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

namespace aerogram::exporter {
namespace {

TEST(SpacingHistogram, Property1_BinsSumUpToTheDistances) {
    std::mt19937_64 random(5);
    for (int round = 0; round < 200; ++round) {
        std::vector<double> distances_m(random() % 300);
        std::lognormal_distribution<double> distance(0.5, round % 2 == 0 ? 0.1 : 1.5);
        for (double& d : distances_m) d = distance(random);
        const auto histogram = spacing_histogram(distances_m, 2.2, 1 + random() % 50);
        EXPECT_EQ(std::accumulate(histogram.bins.begin(), histogram.bins.end(), std::size_t{0}), distances_m.size())
            << "seed 5, round " << round;
        EXPECT_GT(histogram.end_m, 2.2);
    }
}

TEST(SpacingHistogram, EqualDistancesAreOneBinAtTheirPlace) {
    const auto histogram = spacing_histogram(std::vector<double>(50, 2.0), 2.0, 30);
    EXPECT_DOUBLE_EQ(histogram.end_m, 3.0);
    EXPECT_EQ(histogram.bins[20], 50U);
    EXPECT_FALSE(histogram.beyond);
}

TEST(SpacingHistogram, FewThatStandFarOffAreInTheLastBin) {
    std::vector<double> distances_m(99, 2.0);
    distances_m.push_back(500.0);
    const auto histogram = spacing_histogram(distances_m, 2.0, 30);
    EXPECT_DOUBLE_EQ(histogram.end_m, 6.0);
    EXPECT_TRUE(histogram.beyond);
    EXPECT_EQ(histogram.bins.back(), 1U);
}

TEST(RoundStep, IsOneTwoOrFiveTimesAPowerOfTen) {
    EXPECT_DOUBLE_EQ(round_step(1.0), 1.0);
    EXPECT_DOUBLE_EQ(round_step(1.1), 2.0);
    EXPECT_DOUBLE_EQ(round_step(2.5), 5.0);
    EXPECT_DOUBLE_EQ(round_step(5.1), 10.0);
    EXPECT_DOUBLE_EQ(round_step(0.013), 0.02);
    EXPECT_DOUBLE_EQ(round_step(730.0), 1000.0);
}

}  // namespace
}  // namespace aerogram::exporter
