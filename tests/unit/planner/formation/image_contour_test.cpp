#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tests/unit/planner/formation/missions.hpp"
#include "tests/unit/planner/formation/png.hpp"
#include "tests/unit/planner/sampling/random.hpp"

namespace aerogram::planner::testing {
namespace {

using ::testing::HasSubstr;
using Rgba = std::array<std::uint8_t, 4>;

constexpr Rgba kRed{255, 0, 0, 255}, kBlue{0, 0, 255, 255}, kClear{255, 255, 255, 0}, kBlack{0, 0, 0, 255};

ImageSource contour(const OwnFile& file) {
    ImageSource source;
    source.file = file.path();
    source.contour = true;
    return source;
}

double from(double x, double z, const Vec3& p) {
    return std::hypot(p.x - x, p.z - z);
}

/// A disc of radius 80 in the middle of 200 x 200 pixels: red left, blue right.
std::string disc_picture() {
    return png(200, 200, [](auto x, auto y) {
        return std::hypot(x - 99.5, y - 99.5) >= 80.0 ? kClear : x < 100 ? kRed : kBlue;
    });
}

TEST(ImageContour, StandsOnTheLineInTheColoursJustInsideIt) {
    const OwnFile file(".png", disc_picture());
    const Formation formation = built(part_of(contour(file), 50, wide(40)));
    ASSERT_EQ(formation.points_m.size(), 50U);
    for (std::size_t i = 0; i < 50; ++i) {
        const Vec3& p = formation.points_m[i];
        EXPECT_NEAR(from(0, 0, p), 20.0, 0.3);
        if (std::abs(p.x) < 1.0) continue;
        EXPECT_EQ(formation.colors[i], p.x < 0 ? (Rgb{1, 0, 0}) : (Rgb{0, 0, 1})) << p.x << ' ' << p.z;
    }
    EXPECT_EQ(formation.note, "");
    EXPECT_FALSE(formation.coverage_m[0]);
}

TEST(ImageContour, AntialiasedRimsDoNotDarkenTheColours) {
    const OwnFile file(".png", png(400, 400, [](auto x, auto y) {
                           const double inside = 150.0 - std::hypot(x - 199.5, y - 199.5);
                           const double share = std::clamp(0.5 + inside / 3.0, 0.0, 1.0);
                           return Rgba{static_cast<std::uint8_t>(255.0 * share), 0, 0, 255};
                       }));
    for (const Rgb& color : built(part_of(contour(file), 80)).colors) EXPECT_GT(color.r, 0.97);
}

TEST(ImageContour, HolesAreLinesToo) {
    const OwnFile file(".png", png(300, 300, [](auto x, auto y) {
                           const double r = std::hypot(x - 149.5, y - 149.5);
                           return r < 140 && r > 70 ? kRed : kBlack;
                       }));
    const Points points = built(part_of(contour(file), 90, wide(56))).points_m;
    std::size_t outer = 0, inner = 0;
    for (const Vec3& p : points) {
        outer += std::abs(from(0, 0, p) - 28) < 0.3;
        inner += std::abs(from(0, 0, p) - 14) < 0.3;
    }
    EXPECT_EQ(outer + inner, 90U);
    EXPECT_NEAR(static_cast<double>(outer), 60.0, 3.0);
}

TEST(ImageContour, APaletteLimitsTheColours) {
    const OwnFile file(".png", png(120, 120, [](auto x, auto y) {
                           return Rgba{static_cast<std::uint8_t>(2 * x), static_cast<std::uint8_t>(2 * y), 99, 255};
                       }));
    ImageSource source = contour(file);
    source.palette = 3;
    const Formation formation = built(part_of(source, 60));
    EXPECT_EQ(std::set<Rgb>(formation.colors.begin(), formation.colors.end()).size(), 3U);
}

TEST(ImageContour, AFullPictureIsItsRimWithTheCorners) {
    const OwnFile file(".png", png(64, 32, [](auto, auto) { return kRed; }));
    const Points points = built(part_of(contour(file), 30, flat(64, 32))).points_m;
    for (const Vec3& corner : {Vec3(32, 0, 16), Vec3(-32, 0, 16), Vec3(32, 0, -16), Vec3(-32, 0, -16)}) {
        EXPECT_TRUE(std::ranges::any_of(points, [&](const Vec3& p) { return glm::distance(p, corner) < 1e-6; }));
    }
    for (const Vec3& p : points) EXPECT_NEAR(std::max(std::abs(p.x) / 32, std::abs(p.z) / 16), 1.0, 1e-9);
}

TEST(ImageContour, OnePixelAndOneDroneAreEnough) {
    const OwnFile file(".png", png(50, 50, [](auto x, auto y) { return x == 20 && y == 30 ? kRed : kBlack; }));
    for (const std::size_t n : {1U, 2U, 5U}) {
        const Formation formation = built(part_of(contour(file), n));
        EXPECT_EQ(formation.points_m.size(), n);
        for (const Rgb& color : formation.colors) EXPECT_EQ(color, (Rgb{1, 0, 0}));
    }
}

TEST(ImageContour, NothingToBeSeenIsAnError) {
    const OwnFile file(".png", png(20, 20, [](auto, auto) { return kClear; }));
    EXPECT_THAT(build(mission_of({part_of(contour(file), 5)})).error().message, HasSubstr("is dark everywhere"));
}

TEST(ImageContour, HasExactlyNDronesAtTheSpacingForEveryN) {
    const OwnFile file(".png", disc_picture());
    for (const bool lines : {true, false}) {
        ImageSource source = contour(file);
        source.contour = lines;
        for (const std::size_t n : {1U, 2U, 3U, 4U, 5U, 7U, 10U, 100U, 1000U, 20'000U}) {
            if (!lines && n > 1000) continue;
            Mission mission = mission_of({part_of(source, n)});
            mission.limits.ceiling_m = 1e6;
            mission.limits.min_navigation_altitude_m = -1e6;
            const auto formation = build(mission);
            ASSERT_TRUE(formation.ok()) << n << ' ' << formation.error().message;
            EXPECT_EQ(formation->points_m.size(), n);
            EXPECT_EQ(formation->colors.size(), n);
            if (n > 1) {
                EXPECT_GE(formation->smallest_spacing_m, 2.2 - 1e-9) << n;
            }
        }
    }
}

TEST(ImageContour, NoiseIsBoundedAndSaysWhatIsLeftOut) {  // some 100,000 specks
    Random random(5);
    std::vector<bool> lit;
    for (int i = 0; i < 1000 * 1000; ++i) lit.push_back(random.unit() < 0.12);
    const OwnFile file(".png", png(1000, 1000, [&](auto x, auto y) { return lit[1000 * y + x] ? kRed : kBlack; }));
    const Formation formation = built(part_of(contour(file), 300));
    EXPECT_EQ(formation.points_m.size(), 300U);
    EXPECT_THAT(formation.note, ::testing::MatchesRegex("left out [0-9]+ contours too short for two drones"));
}

TEST(ImageContour, LargePicturesAreAveragedFirstAndKeepTheirScale) {
    const OwnFile file(".png", png(3000, 1500, [](auto x, auto y) {
                           return x >= 1200 && y < 900 ? kRed : kBlack;  // 1800 x 900, upper right
                       }));
    const Points points = built(part_of(contour(file), 36, wide(36))).points_m;
    const Box box = box_of(points);
    EXPECT_NEAR(box.size().x, 36, 1e-6);
    EXPECT_NEAR(box.size().z, 18, 1e-6);
}

TEST(ImageFill, APartsDensityMultipliesThePictures) {
    const OwnFile file(".png", png(100, 100, [](auto, auto) { return kRed; }));
    ImageSource source;
    source.file = file.path();
    Part part = part_of(source, 300, flat(90, 90));
    part.density.brush = {{{20, 20}, 18, 5}};
    const Formation formation = built(part);
    std::size_t brushed = 0, mirrored = 0;
    for (const Vec3& p : formation.points_m) {
        brushed += from(20, 20, p) < 12;
        mirrored += from(-20, -20, p) < 12;
    }
    EXPECT_GT(brushed, 2 * mirrored);
    ASSERT_TRUE(formation.coverage_m[0]);
    EXPECT_NEAR(*formation.coverage_m[0], 0.38 * std::sqrt(8100.0 / 300), 0.5);
}

}  // namespace
}  // namespace aerogram::planner::testing
