#include "export/picture/canvas.hpp"

#include <gtest/gtest.h>

#include "pictures.hpp"

namespace aerogram::exporter {
namespace {

planner::Picture decoded(const Canvas& canvas) {
    return *planner::decode_png(*canvas.png());
}

TEST(Canvas, DiscsRingsAndRectanglesAreWhereTheyShould) {
    Canvas canvas(60, 40, {0.0, 0.0, 0.0});
    canvas.disc({10.0, 10.0}, 5.0, {1.0, 0.0, 0.0});
    canvas.ring({30.0, 10.0}, 6.0, 2.0, {0.0, 1.0, 0.0});
    canvas.rectangle({40.0, 20.0}, {10.0, 10.0}, {0.0, 0.0, 1.0});
    const planner::Picture picture = decoded(canvas);
    EXPECT_EQ(picture.width, 60U);
    EXPECT_EQ(picture.height, 40U);
    EXPECT_EQ(pixel(picture, {10.0, 10.0}), 0xFF0000U);
    EXPECT_EQ(pixel(picture, {10.0, 16.0}), 0U);
    EXPECT_EQ(pixel(picture, {30.0, 10.0}), 0U);
    EXPECT_EQ(pixel(picture, {35.5, 10.0}), 0x00FF00U);
    EXPECT_EQ(pixel(picture, {40.0, 20.0}), 0x0000FFU);
    EXPECT_EQ(pixel(picture, {49.0, 29.0}), 0x0000FFU);
    EXPECT_EQ(pixel(picture, {50.0, 30.0}), 0U);
}

TEST(Canvas, DiscsCoverTheirArea) {
    Canvas canvas(100, 100, {0.0, 0.0, 0.0});
    canvas.disc({50.3, 49.6}, 30.0, {1.0, 1.0, 1.0});
    const planner::Picture picture = decoded(canvas);
    double area = 0.0;
    for (std::size_t i = 0; i < 100 * 100; ++i) area += picture.rgba[4 * i] / 255.0;
    EXPECT_NEAR(area, 3.14159265 * 900.0, 6.0);
}

TEST(Canvas, HolesOfRegionsStayOpen) {
    const planner::Region frame{{{{0, 0}, {20, 0}, {20, 20}, {0, 20}}, {{5, 5}, {5, 15}, {15, 15}, {15, 5}}}};
    Canvas canvas(30, 30, {0.0, 0.0, 0.0});
    canvas.fill(frame, {5.0, 5.0}, {1.0, 1.0, 1.0});
    const planner::Picture picture = decoded(canvas);
    EXPECT_EQ(pixel(picture, {7.0, 7.0}), 0xFFFFFFU);
    EXPECT_EQ(pixel(picture, {15.0, 15.0}), 0U);
}

TEST(Canvas, ClippingHoldsUntilItIsTakenAway) {
    Canvas canvas(30, 10, {0.0, 0.0, 0.0});
    canvas.only_inside({0.0, 0.0}, {10.0, 10.0});
    canvas.rectangle({0.0, 0.0}, {30.0, 5.0}, {1.0, 1.0, 1.0});
    canvas.everywhere();
    canvas.rectangle({20.0, 5.0}, {10.0, 5.0}, {1.0, 1.0, 1.0});
    const planner::Picture picture = decoded(canvas);
    EXPECT_EQ(pixel(picture, {9.0, 2.0}), 0xFFFFFFU);
    EXPECT_EQ(pixel(picture, {10.0, 2.0}), 0U);
    EXPECT_EQ(pixel(picture, {25.0, 7.0}), 0xFFFFFFU);
}

TEST(Canvas, Property1_SameCallsSameBytes) {
    const auto draw = [] {
        Canvas canvas(200, 100, {0.1, 0.1, 0.2});
        for (int i = 0; i < 50; ++i) canvas.disc({3.7 * i, 2.1 * i}, 1.0 + 0.3 * i, {0.02 * i, 0.5, 0.3, 0.4});
        return *canvas.png();
    };
    EXPECT_EQ(draw(), draw());
}

TEST(LampInk, IsTheLightAsScreensShowIt) {
    const Ink half = lamp_ink({0.5, 0.0, 1.0});
    EXPECT_NEAR(half.r, 188.0 / 255.0, 1e-12);  // IEC 61966-2-1
    EXPECT_EQ(half.g, 0.0);
    EXPECT_EQ(half.b, 1.0);
}

}  // namespace
}  // namespace aerogram::exporter
