#include "geo/tracks.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace aerogram {
namespace {

const Rgb kRed{1.0, 0.0, 0.0}, kBlue{0.0, 0.0, 1.0}, kDark{};

TEST(LightAt, DarkBeforeTheFirstKeyAndWithoutKeys) {
    EXPECT_EQ(light_at({}, 3.0), kDark);
    const std::vector<LightKey> keys{{1000, kRed, false}};
    EXPECT_EQ(light_at(keys, 0.999999), kDark);
    EXPECT_EQ(light_at(keys, -5.0), kDark);
}

TEST(LightAt, StaysUntilTheNextKeyUnlessItFades) {
    const std::vector<LightKey> keys{{0, kRed, false}, {2000, kBlue, false}};
    EXPECT_EQ(light_at(keys, 1.999), kRed);
    EXPECT_EQ(light_at(keys, 2.0), kBlue);
    EXPECT_EQ(light_at(keys, 1e6), kBlue);
}

TEST(LightAt, FadesLinearlyToTheNextKey) {
    const std::vector<LightKey> keys{{1000, kRed, true}, {3000, kBlue, true}};
    EXPECT_EQ(light_at(keys, 1.0), kRed);
    EXPECT_EQ(light_at(keys, 1.5), (Rgb{0.75, 0.0, 0.25}));
    EXPECT_EQ(light_at(keys, 3.0), kBlue);
    EXPECT_EQ(light_at(keys, 99.0), kBlue);  // a fade without a next key has nowhere to go
}

TEST(LightAt, OfTwoKeysAtOneInstantTheLaterInTheListCounts) {
    const std::vector<LightKey> keys{{0, kDark, true}, {1000, kRed, false}, {1000, kBlue, false}};
    EXPECT_EQ(light_at(keys, 1.0), kBlue);
    EXPECT_EQ(light_at(keys, 0.5), (Rgb{0.5, 0.0, 0.0}));
}

TEST(LightAt, EveryMillisecondIsHitByItsDecimalSecond) {
    // 0.58 * 1000 rounds to 579.99...: comparing in milliseconds would be one step late.
    for (Millis time_ms = 0; time_ms < 100000; time_ms += 20) {
        const std::vector<LightKey> keys{{time_ms, kRed, false}};
        EXPECT_EQ(light_at(keys, static_cast<double>(time_ms) / 1000.0), kRed) << time_ms;
    }
}

TEST(YawAt, ZeroWithoutKeysAndHeldOutsideThem) {
    EXPECT_EQ(yaw_at({}, 1.0), 0.0);
    const std::vector<YawKey> keys{{1000, 0.5}, {2000, -1.5}};
    EXPECT_EQ(yaw_at(keys, 0.0), 0.5);
    EXPECT_EQ(yaw_at(keys, 1.0), 0.5);
    EXPECT_EQ(yaw_at(keys, 2.0), -1.5);
    EXPECT_EQ(yaw_at(keys, 9.0), -1.5);
}

TEST(YawAt, LinearBetweenKeysWithoutWrapping) {
    const std::vector<YawKey> keys{{0, 0.0}, {4000, 12.0}};
    EXPECT_DOUBLE_EQ(yaw_at(keys, 1.0), 3.0);
    EXPECT_DOUBLE_EQ(yaw_at(keys, 3.0), 9.0);
}

TEST(YawAt, TwoKeysAtOneInstantAreAJump) {
    const std::vector<YawKey> keys{{0, 0.0}, {1000, 1.0}, {1000, 3.0}, {2000, 3.0}};
    EXPECT_DOUBLE_EQ(yaw_at(keys, 0.5), 0.5);
    EXPECT_EQ(yaw_at(keys, 1.0), 3.0);
    EXPECT_EQ(yaw_at(keys, 1.5), 3.0);
}

}  // namespace
}  // namespace aerogram
