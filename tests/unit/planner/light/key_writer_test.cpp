#include "planner/light/key_writer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "geo/random.hpp"
#include "geo/units.hpp"

namespace aerogram::planner {
namespace {

constexpr Rgb kRed{1, 0, 0}, kBlue{0, 0, 1}, kDark{};

std::vector<LightKey> written(const std::vector<LightPiece>& pieces, const Rgb& end) {
    KeyWriter out;
    for (const LightPiece& piece : pieces) out.add(piece);
    return std::move(out).finished(pieces.back().to_ms, end);
}

double apart(const Rgb& a, const Rgb& b) {
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

/// The largest difference, sampled every millisecond and just before each piece ends.
double error_of(const std::vector<LightPiece>& pieces, const std::vector<LightKey>& keys) {
    double worst = 0.0;
    for (const LightPiece& piece : pieces) {
        const auto length = static_cast<double>(piece.to_ms - piece.from_ms);
        for (double at = 0.0; at < length; at = at + 1.0 < length || at >= length - 1e-3 ? at + 1.0 : length - 1e-6) {
            const double t_s = (static_cast<double>(piece.from_ms) + at) / 1000.0;
            worst = std::max(worst, apart(light_at(keys, t_s), mix(piece.from, piece.to, at / length)));
        }
    }
    return worst;
}

TEST(KeyWriter, AFadeOfManySamplesHasTwoKeys) {
    std::vector<LightPiece> pieces;
    for (int i = 0; i < 500; ++i)
        pieces.push_back({40 * i, 40 * i + 40, mix(kRed, kBlue, i / 500.0), mix(kRed, kBlue, (i + 1) / 500.0)});
    const std::vector<LightKey> expected{{0, kRed, true}, {20'000, kBlue, false}};
    EXPECT_EQ(written(pieces, kBlue), expected);
}

TEST(KeyWriter, Property3_LightThatDoesNotChangeHasOneKey) {
    std::vector<LightPiece> pieces;
    for (int i = 0; i < 500; ++i) pieces.push_back({40 * i, 40 * i + 40, kRed, kRed});
    EXPECT_EQ(written(pieces, kRed), (std::vector<LightKey>{{0, kRed, false}}));
}

TEST(KeyWriter, Property2_JumpsStayJumps) {
    const std::vector<LightPiece> pieces{
        {0, 40, kDark, kDark}, {40, 80, kRed, kRed}, {80, 120, kDark, kRed}, {120, 160, kBlue, kBlue}};
    const std::vector<LightKey> expected{{0, kDark, false},  {40, kRed, false},   {80, kDark, true},
                                         {120, kRed, false}, {120, kBlue, false}, {160, kDark, false}};
    EXPECT_EQ(written(pieces, kDark), expected);
    EXPECT_LE(error_of(pieces, expected), 1e-6);
}

TEST(KeyWriter, WhatIsAddedAsItIsKeepsItsKeys) {
    KeyWriter out;
    out.add_as_it_is({0, 1000, kRed, kRed});
    out.add_as_it_is({1000, 2000, kRed, kBlue});
    out.add_as_it_is({2000, 3000, kBlue, kDark});
    const std::vector<LightKey> expected{
        {0, kRed, false}, {1000, kRed, true}, {2000, kBlue, true}, {3000, kDark, false}};
    EXPECT_EQ(std::move(out).finished(3000, kDark), expected);
}

/// Every kind of curve, with jumps: brute force against the pieces.
TEST(KeyWriter, Property1_IsWithinItsToleranceEverywhere) {
    Random random(17);
    std::size_t keys_written = 0, samples = 0;
    for (int round = 0; round < 60; ++round) {
        std::vector<LightPiece> pieces;
        Rgb now{random.unit(), random.unit(), random.unit()};
        const double speed = std::pow(10.0, random.between(-4.0, -0.5));
        Millis time_ms = 0;
        for (int i = 0; i < 200; ++i) {
            if (random.unit() < 0.03) now = {random.unit(), random.unit(), random.unit()};
            const double s = speed * i;
            const Rgb wave{0.5 + 0.5 * std::sin(s), 0.5 + 0.5 * std::cos(2.0 * s), now.b};
            const Rgb from = pieces.empty() || random.unit() < 0.02 ? now : pieces.back().to;
            const Millis to_ms = time_ms + 20 * (1 + static_cast<Millis>(random.below(3)));
            pieces.push_back({time_ms, to_ms, from, random.unit() < 0.1 ? from : wave});
            time_ms = to_ms;
        }
        const auto keys = written(pieces, pieces.back().to);
        EXPECT_LE(error_of(pieces, keys), kLightTolerance + 1e-6) << round;
        for (std::size_t k = 1; k < keys.size(); ++k) EXPECT_LE(keys[k - 1].time_ms, keys[k].time_ms);
        keys_written += keys.size();
        samples += pieces.size();
    }
    EXPECT_LT(keys_written, samples);
}

}  // namespace
}  // namespace aerogram::planner
