#include "planner/picture/picture_light.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "geo/random.hpp"

namespace aerogram::planner {
namespace {

Picture random_picture(std::size_t width, std::size_t height, std::uint64_t seed) {
    Random random(seed);
    Picture picture{width, height, {}};
    for (std::size_t i = 0; i < 4 * width * height; ++i)
        picture.rgba.push_back(static_cast<std::uint8_t>(random.below(256)));
    return picture;
}

/// The mean over a square by many small samples.
SeenLight brute(const Picture& picture, double side, const Vec2& place, double reach) {
    constexpr int kSteps = 400;
    SeenLight sum;
    double inside = 0.0;
    for (int i = 0; i < kSteps * kSteps; ++i) {
        const double x = place.x + reach * ((i % kSteps + 0.5) / kSteps * 2.0 - 1.0);
        const double y = place.y + reach * ((i / kSteps + 0.5) / kSteps * 2.0 - 1.0);
        const double column = std::floor(x * side);
        const double row = std::floor(static_cast<double>(picture.height) - y * side);
        if (column < 0.0 || row < 0.0 || column >= static_cast<double>(picture.width) ||
            row >= static_cast<double>(picture.height))
            continue;
        const auto pixel = static_cast<std::size_t>(row) * picture.width + static_cast<std::size_t>(column);
        const Rgb light = picture.light(pixel);
        const double alpha = picture.alpha(pixel);
        sum.color = {sum.color.r + alpha * light.r, sum.color.g + alpha * light.g, sum.color.b + alpha * light.b};
        sum.alpha += alpha;
        inside += 1.0;
    }
    if (inside == 0.0) return {};
    return {{sum.color.r / inside, sum.color.g / inside, sum.color.b / inside}, sum.alpha / inside};
}

TEST(PictureLight, IsTheMeanOfWhatLiesAround) {
    Random random(4);
    const Picture picture = random_picture(13, 9, 8);
    const PictureLight light(picture, 1000);
    ASSERT_EQ(light.size(), Vec2(13.0, 9.0));
    for (int round = 0; round < 25; ++round) {
        const Vec2 place(random.between(-1.0, 14.0), random.between(-1.0, 10.0));
        const double reach = random.between(0.5, 4.0);
        const SeenLight seen = light.around(place, reach), expected = brute(picture, 1.0, place, reach);
        EXPECT_NEAR(seen.color.r, expected.color.r, 0.01) << place.x << ' ' << place.y << ' ' << reach;
        EXPECT_NEAR(seen.color.g, expected.color.g, 0.01);
        EXPECT_NEAR(seen.color.b, expected.color.b, 0.01);
        EXPECT_NEAR(seen.alpha, expected.alpha, 0.01);
    }
}

TEST(PictureLight, AtAPixelsMiddleHalfACellAroundIsThatPixel) {
    const Picture picture = random_picture(5, 4, 2);
    const PictureLight light(picture, 20);
    for (std::size_t row = 0; row < 4; ++row) {
        for (std::size_t column = 0; column < 5; ++column) {
            const std::size_t pixel = 5 * row + column;
            const SeenLight seen =
                light.around({static_cast<double>(column) + 0.5, 3.5 - static_cast<double>(row)}, 0.5);
            EXPECT_NEAR(seen.alpha, picture.alpha(pixel), 1e-6);
            EXPECT_NEAR(seen.color.g, picture.alpha(pixel) * picture.light(pixel).g, 1e-6);
        }
    }
}

/// The lights of a white picture were 1 + 2e-16: verify refused the show.
TEST(PictureLight, NothingIsBrighterThanWhite) {
    const Picture white{7, 7, std::vector<std::uint8_t>(4 * 49, 255)};
    const PictureLight light(white, 49);
    Random random(3);
    for (int round = 0; round < 20'000; ++round) {
        const SeenLight seen =
            light.around({random.between(0.0, 7.0), random.between(0.0, 7.0)}, random.between(0.5, 4));
        ASSERT_LE(seen.color.r, 1.0);
        ASSERT_LE(seen.alpha, 1.0);
    }
}

TEST(PictureLight, OutsideThereIsNothing) {
    const PictureLight light(random_picture(5, 4, 2), 20);
    EXPECT_EQ(light.around({-1.0, 2.0}, 0.9).alpha, 0.0);
    EXPECT_EQ(light.around({2.0, 5.0}, 0.9).alpha, 0.0);
    EXPECT_GT(light.around({2.0, 4.5}, 0.9).alpha, 0.0);
}

TEST(PictureLight, LargePicturesKeepMeansOfSquares) {
    const Picture picture = random_picture(41, 30, 6);
    const PictureLight light(picture, 100);  // squares of 4 pixels: 11 x 8
    ASSERT_EQ(light.size(), Vec2(41.0 / 4.0, 30.0 / 4.0));
    // Whole squares; rows are counted from the top.
    const SeenLight seen = light.around({2.0, 7.5 - 3.0}, 1.0), expected = brute(picture, 4.0, {2.0, 7.5 - 3.0}, 1.0);
    EXPECT_NEAR(seen.color.r, expected.color.r, 1e-3);
    EXPECT_NEAR(seen.alpha, expected.alpha, 1e-3);
}

TEST(PictureFit, CoversTheBoxAndKeepsTheAspect) {
    const PictureLight light(random_picture(40, 20, 1), 1000);
    EXPECT_EQ(fit_over(light, {10, 10}, 100).cells_per_m, Vec2(2.0));  // by its height: 20 cells over 10
    EXPECT_EQ(fit_over(light, {40, 5}, 100).cells_per_m, Vec2(1.0));
    EXPECT_EQ(fit_over(light, {20, 0}, 100).cells_per_m, Vec2(2.0));
    EXPECT_EQ(fit_over(light, {0, 0}, 1).cells_per_m, Vec2(0.0));
    EXPECT_DOUBLE_EQ(fit_over(light, {10, 10}, 4).reach, 0.35 * 10.0);  // 400 cells for 4 places
    EXPECT_EQ(fit_over(light, {10, 10}, 1000).reach, 0.5);
    EXPECT_EQ(fit_size(light, {10, 10}, {8, 8}, 100).cells_per_m, Vec2(4.0, 2.0));
    EXPECT_EQ(fit_size(light, {10, 0}, {8, 8}, 100).cells_per_m, Vec2(4.0, 4.0));
    EXPECT_EQ(fit_size(light, {0, 5}, {8, 8}, 100).cells_per_m, Vec2(4.0, 4.0));
    EXPECT_EQ(fit_size(light, {0, 0}, {10, 10}, 100).cells_per_m, Vec2(2.0));
}

}  // namespace
}  // namespace aerogram::planner
