#include "export/picture/strip_picture.hpp"

#include <gtest/gtest.h>

#include "export/picture/picture_size.hpp"
#include "pictures.hpp"

namespace aerogram::exporter {
namespace {

std::size_t count_of(const planner::Picture& picture, std::uint32_t color) {
    std::size_t count = 0;
    for (std::size_t y = 0; y < picture.height; ++y) {
        for (std::size_t x = 0; x < picture.width; ++x) {
            if (pixel(picture, {static_cast<double>(x), static_cast<double>(y)}) == color) ++count;
        }
    }
    return count;
}

StripFrame frame_of(const Rgb& color) {
    return {"frame", {{{0, 0, 30}, color}, {{10, 0, 30}, color}, {{5, 0, 38}, color}}};
}

TEST(StripPicture, EachFrameHasItsColours) {
    const auto png = strip_picture("show", "", {frame_of({1, 0, 0}), frame_of({0, 1, 0}), frame_of({0, 0, 1})}, 640);
    const planner::Picture picture = *planner::decode_png(*png);
    const std::size_t red = count_of(picture, 0xFF0000U);
    EXPECT_GT(red, 3 * 40U);
    EXPECT_NEAR(static_cast<double>(count_of(picture, 0x00FF00U)), static_cast<double>(red),
                0.1 * static_cast<double>(red));
    EXPECT_NEAR(static_cast<double>(count_of(picture, 0x0000FFU)), static_cast<double>(red),
                0.1 * static_cast<double>(red));
}

TEST(StripPicture, AnyNumberOfFramesFitsAPage) {
    for (const std::size_t count : {std::size_t{1}, std::size_t{2}, std::size_t{7}, kMostStripFrames}) {
        const auto png = strip_picture("show", "", std::vector(count, frame_of({1, 1, 1})), kPicture_px);
        const planner::Picture picture = *planner::decode_png(*png);
        EXPECT_EQ(picture.width, static_cast<std::size_t>(kPicture_px));
        EXPECT_LE(picture.height, 1500U) << count;
        EXPECT_GT(count_of(picture, 0xFFFFFFU), 0U) << count;
    }
}

TEST(StripPicture, DarkFleetsAndOneDroneAreDrawn) {
    const StripFrame dark{"0.00 s", {{{0, 0, 0}, {}}}};
    EXPECT_TRUE(strip_picture("show", "", {dark}, 640).ok());
    const StripFrame far{"0.00 s", {{{-1e8, 1e8, 1e8}, {1, 1, 1}}, {{1e8, 1e8, -1e8}, {1, 1, 1}}}};
    EXPECT_TRUE(strip_picture("show", "", {far, dark}, 640).ok());
}

}  // namespace
}  // namespace aerogram::exporter
