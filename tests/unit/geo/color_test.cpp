#include "geo/color.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

namespace aerogram {
namespace {

TEST(Color, HexIsDecodedBySrgbCurve) {
    // Published values of the sRGB curve (IEC 61966-2-1): 0x80 is 21.586 % of the light, 0x0a is on the linear foot.
    const auto grey = rgb_from_hex("#808080");
    ASSERT_TRUE(grey.ok());
    EXPECT_NEAR(grey->r, 0.21586, 5e-6);
    EXPECT_EQ(grey->r, grey->b);
    EXPECT_NEAR(rgb_from_hex("#0a0000")->r, 10.0 / 255.0 / 12.92, 1e-15);
    EXPECT_EQ(*rgb_from_hex("#ffffff"), (Rgb{1.0, 1.0, 1.0}));
    EXPECT_EQ(*rgb_from_hex("#000000"), (Rgb{0.0, 0.0, 0.0}));
}

TEST(Color, ChannelsAreInOrder) {
    const Rgb c = *rgb_from_hex("#ff8000");
    EXPECT_EQ(c.r, 1.0);
    EXPECT_NEAR(c.g, 0.21586, 5e-6);
    EXPECT_EQ(c.b, 0.0);
}

TEST(Color, ShortFormDoublesEachDigitAndCaseDoesNotMatter) {
    EXPECT_EQ(*rgb_from_hex("#f80"), *rgb_from_hex("#ff8800"));
    EXPECT_EQ(*rgb_from_hex("#AbCdEf"), *rgb_from_hex("#abcdef"));
}

TEST(Color, EveryByteComesBackFromLinearLight) {
    for (unsigned value = 0; value < 256; ++value) {
        std::array<char, 8> text{};
        std::snprintf(text.data(), text.size(), "#%02x%02x%02x", value, 255 - value, (value * 7) % 256);
        EXPECT_EQ(hex_from_rgb(*rgb_from_hex(text.data())), text.data());
    }
}

TEST(Color, WhatIsNoColourIsRefusedWithItsText) {
    for (const char* text :
         {"", "#", "ff8800", "#ff880", "#ff88001", "#gg0000", "red", "# f800", "#12345", "#-10000"}) {
        const auto color = rgb_from_hex(text);
        ASSERT_FALSE(color.ok()) << text;
        EXPECT_EQ(color.error().code, ErrorCode::invalid_input);
        EXPECT_EQ(color.error().message,
                  "\"" + std::string(text) + "\" is not a colour: must be \"#rgb\" or \"#rrggbb\"");
    }
}

TEST(Color, LightOutsideTheLampsRangeIsClamped) {
    EXPECT_EQ(hex_from_rgb({-0.5, 1.5, 0.0}), "#00ff00");
    EXPECT_EQ(quantised({-0.5, 1.5, 1.0}), (Rgb8{0, 255, 255}));
    EXPECT_EQ(quantised({std::numeric_limits<double>::infinity(), 0.0, 0.0}), (Rgb8{255, 0, 0}));
}

TEST(Color, QuantisingRoundsToTheNearestStepAndIsIdempotent) {
    EXPECT_EQ(quantised({0.49 / 255.0, 0.51 / 255.0, 254.4 / 255.0}), (Rgb8{0, 1, 254}));
    for (unsigned value = 0; value < 256; ++value) {
        const auto byte = static_cast<std::uint8_t>(value);
        EXPECT_EQ(quantised(from_8bit({byte, 0, 255})), (Rgb8{byte, 0, 255}));
    }
}

TEST(Color, NotANumberIsABug) {
    EXPECT_THROW((void)quantised({std::nan(""), 0.0, 0.0}), ContractViolation);
    EXPECT_THROW((void)hex_from_rgb({0.0, 0.0, std::nan("")}), ContractViolation);
}

TEST(Color, MixIsLinearInLight) {
    EXPECT_EQ(mix({0.0, 1.0, 0.5}, {1.0, 0.0, 0.5}, 0.25), (Rgb{0.25, 0.75, 0.5}));
}

}  // namespace
}  // namespace aerogram
