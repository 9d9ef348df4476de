#include "planner/transition/flow_clock.hpp"

#include <gtest/gtest.h>

#include "tests/unit/planner/transition/shapes.hpp"

namespace aerogram::planner {
namespace {

using namespace testing;

double u(const FlowClock& clock, double knot) {
    const FlowPlace place = clock.at(knot);
    return static_cast<double>(place.leg) + place.share;
}

/// Keyframes on a line at the given stations.
std::vector<SpectralKeyframe> stations(const std::vector<double>& xs) {
    std::vector<SpectralKeyframe> out;
    for (const double x : xs) out.push_back({{Vec3{x, 0, 10}, Vec3{x, 5, 10}}, complete_graph(2)});
    return out;
}

TEST(FlowClock, Property1To3OnRandomKnotsAndCorners) {
    const int count = tries(60);
    for (int seed = 1; seed <= count; ++seed) {
        SCOPED_TRACE(seed);
        Random random(static_cast<std::uint64_t>(seed));
        std::vector<std::size_t> knots{0};
        std::vector<FlowLeg> legs(1 + random.below(6));
        for (FlowLeg& leg : legs) {
            leg.options.corner = random.below(4) == 0;
            knots.push_back(knots.back() + 8 + random.below(60));
        }
        const FlowClock clock(knots, legs);
        for (std::size_t j = 0; j < knots.size(); ++j) {
            EXPECT_NEAR(u(clock, static_cast<double>(knots[j])), static_cast<double>(j), 1e-13);
        }
        const double end = static_cast<double>(knots.back());
        double last = 0.0;
        for (double t = 0.0; t <= end; t += 0.05) {
            EXPECT_GE(u(clock, t), last - 1e-13);
            last = u(clock, t);
        }
        constexpr double kStep = 1e-3;
        const auto slope = [&](double t) { return (u(clock, t + kStep) - u(clock, t - kStep)) / (2 * kStep); };
        for (std::size_t j = 1; j + 1 < knots.size(); ++j) {
            const double t = static_cast<double>(knots[j]);
            EXPECT_NEAR(slope(t - kStep), slope(t + kStep), 1e-7);
            const double bend = (u(clock, t + kStep) - 2 * u(clock, t) + u(clock, t - kStep)) / (kStep * kStep);
            EXPECT_NEAR(bend, 0.0, 1e-4);  // no second difference on either side: u'' is continuous there
            if (legs[j - 1].options.corner) {
                EXPECT_NEAR(slope(t), 0.0, 1e-7);
            } else {
                EXPECT_GT(slope(t), 0.5 / static_cast<double>(knots[j + 1] - knots[j - 1]));
            }
        }
        EXPECT_NEAR((u(clock, kStep) - u(clock, 0.0)) / kStep, 0.0, 1e-7);
        EXPECT_NEAR((u(clock, end) - u(clock, end - kStep)) / kStep, 0.0, 1e-7);
    }
}

TEST(FlowClock, CruisesEvenlyBetweenStartAndStop) {
    const std::vector<FlowLeg> legs(4);
    const FlowClock clock({0, 15, 25, 35, 50}, legs);
    for (double t = 15.0; t < 35.0; t += 0.5) EXPECT_NEAR(u(clock, t + 0.5) - u(clock, t), 0.05, 1e-13);
    for (double t = 0.0; t < 50.0; t += 0.5) EXPECT_LT(u(clock, t + 0.5) - u(clock, t), 0.0515);
}

TEST(FlowKnots, DefaultBalancesSpeedsAndGivesStartsAndStopsMoreTime) {
    const std::vector<FlowLeg> legs(4);
    const auto keyframes = stations({0, 10, 20, 40, 50});
    const std::vector<std::size_t> knots = flow_knots(keyframes, legs, 30);
    const auto length = [&](std::size_t j) { return static_cast<double>(knots[j + 1] - knots[j]); };
    EXPECT_NEAR(length(0) / length(1), 1.5, 0.1);
    EXPECT_NEAR(length(2) / length(1), 2.0, 0.1);
    EXPECT_NEAR(length(3) / length(1), 1.5, 0.1);
    EXPECT_GE(knots.back(), 120U);
    EXPECT_LE(knots.back(), 150U);
}

TEST(FlowKnots, DurationsAreSharesOfTheTime) {
    std::vector<FlowLeg> legs(3);
    legs[0].duration_s = 5.0;
    legs[1].duration_s = 7.0;
    legs[2].duration_s = 4.0;
    const std::vector<std::size_t> knots = flow_knots(stations({0, 1, 2, 30}), legs, 15);
    // 45 to 56 knots: 48 is the total at which 5 : 7 : 4 falls on whole knots.
    EXPECT_EQ(knots, (std::vector<std::size_t>{0, 15, 36, 48}));
}

TEST(FlowKnots, LegsWithoutDurationTakeTheMeanSpeedOfTheOthers) {
    std::vector<FlowLeg> legs(4);
    legs[1].duration_s = 6.0;
    const std::vector<std::size_t> knots = flow_knots(stations({0, 10, 20, 30, 40}), legs, 40);
    const auto length = [&](std::size_t j) { return static_cast<double>(knots[j + 1] - knots[j]); };
    EXPECT_NEAR(length(2) / length(1), 1.0, 0.05);
    EXPECT_NEAR(length(0) / length(1), 1.5, 0.05);
}

TEST(FlowKnots, StandingLegsAndShortSharesKeepEnoughKnots) {
    std::vector<FlowLeg> legs(3);
    legs[1].duration_s = 0.01;
    legs[0].duration_s = legs[2].duration_s = 50.0;
    for (const auto& keyframes : {stations({0, 0, 0, 0}), stations({0, 100, 100, 200})}) {
        const std::vector<std::size_t> knots = flow_knots(keyframes, legs, 4);
        for (std::size_t j = 0; j < 3; ++j) EXPECT_GE(knots[j + 1] - knots[j], kLeastKnotsPerLeg);
    }
    EXPECT_EQ(flow_knots(stations({0, 0}), std::vector<FlowLeg>(1), 20), (std::vector<std::size_t>{0, 20}));
}

}  // namespace
}  // namespace aerogram::planner
