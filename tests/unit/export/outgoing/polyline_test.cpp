#include "export/outgoing/polyline.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

using ::testing::ElementsAre;

/// The line through corners at a time, by the definition.
Vec3 place_at(std::span<const Corner> corners, double time_ms) {
    std::size_t k = 0;
    while (k + 2 < corners.size() && static_cast<double>(corners[k + 1].time_ms) <= time_ms) ++k;
    const Corner &a = corners[k], &b = corners[k + 1];
    const double u = (time_ms - static_cast<double>(a.time_ms)) / static_cast<double>(b.time_ms - a.time_ms);
    return (1.0 - u) * a.place_m + u * b.place_m;
}

/// A drone that stands, flies smoothly, jitters and stands again; uneven times.
std::vector<Corner> random_corners(std::uint64_t seed, std::size_t count) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    std::vector<Corner> corners;
    Vec3 place{10.0 * unit(random), 10.0 * unit(random), 0.0}, velocity{};
    Millis time_ms = 0;
    for (std::size_t k = 0; k < count; ++k) {
        corners.push_back({time_ms, place});
        const double dt_s = 0.01 * static_cast<double>(1 + random() % 30);
        time_ms += std::llround(dt_s * 1000.0);
        const std::size_t mood = k / 40 % 4;
        if (mood == 0) velocity = {};
        if (mood == 1) velocity += dt_s * Vec3(unit(random), unit(random), unit(random));
        place += dt_s * velocity;
        if (mood == 2) place += 0.02 * Vec3(unit(random), unit(random), unit(random));
    }
    return corners;
}

TEST(Polyline, SamplingStepIsTheLargestThatHoldsTheChordBound) {
    constexpr std::array<Millis, 4> kSteps{250, 125, 50, 10};
    EXPECT_EQ(sampling_step_ms(2.0, 0.02, kSteps), 250);   // 2 · 0.25² / 8 = 15.6 mm
    EXPECT_EQ(sampling_step_ms(2.0, 0.015, kSteps), 125);  // 3.9 mm
    EXPECT_EQ(sampling_step_ms(0.0, 0.0, kSteps), 250);
    EXPECT_EQ(sampling_step_ms(2.0, 1e-5, kSteps), std::nullopt);
}

TEST(Polyline, SamplingTimesAreUniformWithTheExactEnd) {
    EXPECT_THAT(sampling_times(1'000, 250), ElementsAre(0, 250, 500, 750, 1'000));
    EXPECT_THAT(sampling_times(900, 250), ElementsAre(0, 250, 500, 750, 900));
    EXPECT_THAT(sampling_times(751, 250), ElementsAre(0, 250, 500, 625, 751));
    EXPECT_THAT(sampling_times(3, 250), ElementsAre(0, 3));
    for (Millis duration = 250; duration < 1'600; ++duration) {
        const auto times = sampling_times(duration, 250);
        for (std::size_t k = 1; k < times.size(); ++k) {
            EXPECT_GE(times[k] - times[k - 1], 125) << duration;
            EXPECT_LE(times[k] - times[k - 1], 250) << duration;
        }
        EXPECT_EQ(times.back(), duration);
    }
}

TEST(Polyline, SampledIsTheFlightAtTheTimes) {
    Flight flight;  // x = t² over 2 s, then stands
    flight.controls_m = {{0, 0, 0}, {0, 0, 0}, {4, 0, 0}, {4, 0, 0}};
    flight.pieces = {{0.0, 2.0, 0, 2}, {2.0, 1.0, 3, 0}};
    const std::vector<Millis> times{0, 500, 1'500, 2'000, 2'700, 3'000};
    const auto corners = sampled(flight, times);
    ASSERT_EQ(corners.size(), times.size());
    for (std::size_t k = 0; k < times.size(); ++k) {
        const double t_s = std::min(2.0, seconds_from_ms(times[k]));
        EXPECT_EQ(corners[k].time_ms, times[k]);
        EXPECT_NEAR(corners[k].place_m.x, t_s * t_s, 1e-12);
    }
}

TEST(Polyline, SampledChordsAreWithinTheStatedError) {
    Flight flight;
    flight.controls_m = {{0, 0, 0}, {1, 0, 0}, {1, 2, 1}, {3, 2, 5}};
    flight.pieces = {{0.0, 4.0, 0, 3}};
    constexpr std::array<Millis, 5> kSteps{1'000, 500, 250, 100, 50};
    const double allowed_m = 0.01;
    const auto step = sampling_step_ms(largest_acceleration_mps2(flight), allowed_m, kSteps);
    ASSERT_TRUE(step);
    const auto corners = sampled(flight, sampling_times(4'000, *step));
    FlightCursor cursor(flight);
    for (int t = 0; t <= 4'000; ++t)
        EXPECT_LE(glm::length(cursor.position_at(t / 1000.0) - place_at(corners, t)), allowed_m) << t;
}

/// Property 1, by brute force over all corners; first and last stay, times rise.
TEST(Thinned, Property1LineIsWithinToleranceOfEveryCorner) {
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        for (const double tolerance_m : {0.0, 0.001, 0.02, 0.5}) {
            const auto corners = random_corners(seed, 2 + seed * 7);
            const auto kept = thinned(corners, tolerance_m);
            ASSERT_GE(kept.size(), 2u);
            EXPECT_EQ(kept.front().time_ms, corners.front().time_ms);
            EXPECT_EQ(kept.back().place_m, corners.back().place_m);
            for (std::size_t k = 1; k < kept.size(); ++k) ASSERT_GT(kept[k].time_ms, kept[k - 1].time_ms);
            for (const Corner& corner : corners) {
                const Vec3 off = place_at(kept, static_cast<double>(corner.time_ms)) - corner.place_m;
                ASSERT_LE(glm::length(off), tolerance_m + 2e-9) << "seed " << seed << " at " << corner.time_ms;
            }
        }
    }
}

TEST(Thinned, Property2StandingCostsTwoCorners) {
    std::vector<Corner> corners;
    for (int k = 0; k < 5'000; ++k) corners.push_back({k * 100, {1.0, -2.0, 3.0}});
    EXPECT_EQ(thinned(corners, 0.0).size(), 2u);
    EXPECT_EQ(thinned(corners, 0.02).size(), 2u);
}

TEST(Thinned, Property3ToleranceZeroKeepsAllButStraightOnes) {
    std::vector<Corner> corners;
    for (int k = 0; k <= 40; ++k) corners.push_back({k * 50, {0.1 * k, -0.2 * k, k <= 20 ? 0.0 : 0.3 * (k - 20)}});
    const auto kept = thinned(corners, 0.0);
    ASSERT_EQ(kept.size(), 3u);
    EXPECT_EQ(kept[1].time_ms, 1'000);
    std::vector<Corner> parabola;
    for (int k = 0; k <= 40; ++k) parabola.push_back({k * 50, {0.001 * k * k, 0.0, 0.0}});
    EXPECT_EQ(thinned(parabola, 0.0).size(), parabola.size());
}

/// A parabola a t² / 2 needs chords of T = sqrt(8 tolerance / a); a greedy pass on samples loses one sample a chord.
TEST(Thinned, KeepsAboutAsFewCornersAsAParabolaNeeds) {
    constexpr double kTolerance_m = 0.02;
    const Vec3 a{1.2, -0.9, 0.8};
    std::vector<Corner> corners;
    for (int k = 0; k <= 12'000; ++k) {
        const double t_s = 0.01 * k;
        corners.push_back({k * 10, 0.5 * t_s * t_s * a});
    }
    const double chord_s = std::sqrt(8.0 * kTolerance_m / glm::length(a));
    const std::size_t kept = thinned(corners, kTolerance_m).size();
    EXPECT_LE(static_cast<double>(kept), 120.0 / (chord_s - 0.02) + 2.0);
    EXPECT_GE(static_cast<double>(kept), 120.0 / chord_s);
}

/// Nothing can be left out but neighbours: no line may look all the way to the end.
TEST(Thinned, ZigzagsStayCheap) {
    std::vector<Corner> corners;
    for (int k = 0; k < 200'000; ++k) corners.push_back({k * 10, Vec3(k % 2 == 0 ? 0.0 : 0.018)});
    const auto kept = thinned(corners, 0.02);
    EXPECT_GT(kept.size(), 1'000u);
    for (std::size_t k = 0; k < corners.size(); k += 1'001) {
        const Corner& corner = corners[k];
        const auto after = std::ranges::upper_bound(kept, corner.time_ms, {}, &Corner::time_ms);
        const auto from = std::min(after - 1 - kept.begin(), std::ptrdiff_t(kept.size()) - 2);
        const std::span<const Corner> pair(&kept[static_cast<std::size_t>(from)], 2);
        EXPECT_LE(glm::length(place_at(pair, static_cast<double>(corner.time_ms)) - corner.place_m), 0.02 + 2e-9);
    }
}

TEST(Thinned, FewCornersAreKept) {
    EXPECT_TRUE(thinned({}, 1.0).empty());
    const std::vector<Corner> two{{0, {0, 0, 0}}, {10, {1, 0, 0}}};
    EXPECT_EQ(thinned(two, 100.0).size(), 2u);
}

}  // namespace
}  // namespace aerogram::exporter
