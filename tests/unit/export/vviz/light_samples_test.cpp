#include "export/vviz/light_samples.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace aerogram::exporter {
namespace {

using ::testing::ElementsAre;

constexpr Rgb kRed{1, 0, 0}, kBlue{0, 0, 1};
constexpr Rgb8 kDark8{0, 0, 0}, kRed8{255, 0, 0}, kBlue8{0, 0, 255};

TEST(LightSamples, HoldColoursAndJumpInOneFrame) {
    EXPECT_THAT(light_samples({}, 20), ElementsAre(LightSample{0, kDark8}));
    const std::vector<LightKey> keys{{100, kRed, false}, {1'000, kBlue, false}, {2'000, kBlue, false}};
    EXPECT_THAT(light_samples(keys, 20),
                ElementsAre(LightSample{0, kDark8}, LightSample{4, kDark8}, LightSample{5, kRed8},
                            LightSample{49, kRed8}, LightSample{50, kBlue8}));
}

TEST(LightSamples, FadesHaveASampleEveryTenFramesOrThirtyTwo) {
    const std::vector<LightKey> keys{{0, {0, 0, 0}, true}, {500, kRed, false}};
    EXPECT_THAT(light_samples(keys, 20), ElementsAre(LightSample{0, kDark8}, LightSample{8, {82, 0, 0}},
                                                     LightSample{16, {163, 0, 0}}, LightSample{25, kRed8}));
    const std::vector<LightKey> slow{{0, {0, 0, 0}, true}, {60'000, kRed, false}};
    EXPECT_EQ(light_samples(slow, 20).size(), 33u);
}

/// The three properties on random tracks, several keys in a frame included.
TEST(LightSamples, PropertiesHoldOnRandomTracks) {
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        std::mt19937_64 random(seed);
        std::vector<LightKey> keys;
        Millis time_ms = 0;
        for (std::size_t k = 0; k < random() % 12; ++k) {
            const auto shade = [&] { return static_cast<double>(random() % 5) / 4.0; };
            keys.push_back(
                {time_ms += 20 * static_cast<Millis>(random() % 40), {shade(), shade(), shade()}, random() % 2 == 0});
        }
        const auto samples = light_samples(keys, 20);
        ASSERT_FALSE(samples.empty());
        EXPECT_EQ(samples[0].frame, 0);
        for (std::size_t k = 1; k < samples.size(); ++k) ASSERT_GT(samples[k].frame, samples[k - 1].frame);
        for (std::size_t k = 2; k < samples.size(); ++k)
            EXPECT_FALSE(samples[k].color == samples[k - 1].color && samples[k].color == samples[k - 2].color);
        std::vector<LightKey> again;
        for (std::size_t k = 0; k < samples.size(); ++k)
            again.push_back({samples[k].frame * 20, from_8bit(samples[k].color), true});
        for (Millis t = 0; t <= time_ms + 100; t += 20) {
            const Rgb exact = light_at(keys, static_cast<double>(t) / 1000.0);
            const Rgb read = light_at(again, static_cast<double>(t) / 1000.0);
            ASSERT_NEAR(read.r, exact.r, 0.5 / 255.0 + 1e-9) << "seed " << seed << " at " << t;
            ASSERT_NEAR(read.b, exact.b, 0.5 / 255.0 + 1e-9) << "seed " << seed << " at " << t;
        }
    }
}

// A lamp that stayed dim and then flashed was read as fading up to the flash (missions/lights.toml).
TEST(LightSamples, AJumpAtTheEndOfALevelFadeKeepsWhatWasBefore) {
    const Rgb dim{0.1, 0.1, 0.1}, flash{1.0, 1.0, 1.0};
    const std::vector<LightKey> keys{{0, dim, true}, {2'000, dim, false}, {2'000, flash, false}};
    const auto samples = light_samples(keys, 20);
    ASSERT_GE(samples.size(), 2u);
    EXPECT_EQ(samples.back(), (LightSample{100, quantised(flash)}));
    EXPECT_EQ(samples[samples.size() - 2], (LightSample{99, quantised(dim)}));
}

}  // namespace
}  // namespace aerogram::exporter
