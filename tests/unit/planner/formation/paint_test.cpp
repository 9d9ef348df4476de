#include "planner/formation/paint.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <set>

#include "planner/formation/color_ramp.hpp"
#include "tests/unit/planner/formation/missions.hpp"

namespace aerogram::planner::testing {
namespace {

using ::testing::HasSubstr;

constexpr Rgb kRed{1, 0, 0}, kGreen{0, 1, 0}, kBlue{0, 0, 1}, kDark{};
const Vec3 kSeat{0, -80, 1.7};
const std::filesystem::path kQuarters =  // red | green above blue | transparent
    std::filesystem::path(AEROGRAM_SOURCE_DIR) / "tests/unit/planner/formation/pictures/quarters.png";

std::vector<Rgb> colors_of(const Paint& paint, const Points& points_m, const Vec3& seat_m = kSeat,
                           std::uint64_t seed = 1) {
    auto colors = painted(paint, points_m, seat_m, seed);
    return std::move(colors).value();
}

void expect_near(const Rgb& a, const Rgb& b, double tolerance = 1e-9) {
    EXPECT_NEAR(a.r, b.r, tolerance);
    EXPECT_NEAR(a.g, b.g, tolerance);
    EXPECT_NEAR(a.b, b.b, tolerance);
}

/// An upright wall of places around a middle.
Points wall(const Vec3& middle_m, double width_m, double height_m, int columns, int rows) {
    Points out;
    for (int i = 0; i < columns * rows; ++i) {
        out.push_back(middle_m + Vec3{width_m * (i % columns / (columns - 1.0) - 0.5), 0.0,
                                      height_m * (i / columns / (rows - 1.0) - 0.5)});
    }
    return out;
}

TEST(ColorRamp, MeetsItsColorsAndIsLinearBetween) {
    const std::vector<Rgb> colors{kRed, kGreen, kBlue};
    EXPECT_EQ(ramp_color(colors, -1.0), kRed);
    EXPECT_EQ(ramp_color(colors, 0.5), kGreen);
    EXPECT_EQ(ramp_color(colors, 7.0), kBlue);
    expect_near(ramp_color(colors, 0.6), mix(kGreen, kBlue, 0.2));
    EXPECT_EQ(ramp_color({kGreen}, 0.3), kGreen);
    expect_near(ring_color(colors, 2.0 / 3.0), kBlue);
    expect_near(ring_color(colors, 5.0 / 6.0), mix(kBlue, kRed, 0.5));
    expect_near(ring_color(colors, -1.0 / 6.0), mix(kBlue, kRed, 0.5));
}

TEST(Paint, Property2_AGradientsEndsAreMetAtTheEndsOfItsDirection) {
    const Points points{{3, 0, 0}, {1, 5, 2}, {-1, 9, 8}, {0, 0, 4}};
    for (const Vec3& direction : {Vec3{1, 0, 0}, Vec3{0, 0, 2}, Vec3{1, -2, 0.5}, Vec3{-3, 0, 0}}) {
        const auto colors = colors_of(Gradient{{kRed, kGreen, kBlue}, direction, false}, points);
        std::size_t low = 0, high = 0;
        const auto way = [&](std::size_t i) { return glm::dot(points[i], direction); };
        for (std::size_t i = 1; i < points.size(); ++i) {
            if (way(i) < way(low)) low = i;
            if (way(i) > way(high)) high = i;
        }
        EXPECT_EQ(colors[low], kRed);
        EXPECT_EQ(colors[high], kBlue);
        for (std::size_t i = 0; i < points.size(); ++i)
            expect_near(colors[i], ramp_color({kRed, kGreen, kBlue}, (way(i) - way(low)) / (way(high) - way(low))));
    }
}

TEST(Paint, ARadialGradientRunsFromTheBoxsMiddleToTheFarthestDrone) {
    const Points points{{-4, 0, 0}, {4, 0, 0}, {0, 3, 0}, {0, -3, 0}, {0, 0, 0}};
    const auto colors = colors_of(Gradient{{kRed, kBlue}, {1, 0, 0}, true}, points);
    EXPECT_EQ(colors[0], kBlue);
    EXPECT_EQ(colors[1], kBlue);
    expect_near(colors[2], mix(kRed, kBlue, 0.75));
    EXPECT_EQ(colors[4], kRed);
    EXPECT_EQ(colors_of(Gradient{{kRed, kBlue}, {1, 0, 0}, true}, {{1, 2, 3}}), std::vector<Rgb>{kRed});
}

TEST(Paint, PalettesAreDealtBySlotOrByTheSeed) {
    const Points points(300, Vec3{});
    const Palette by_slot{{kRed, kGreen, kBlue}, PaletteBy::slot}, random{{kRed, kGreen, kBlue}, PaletteBy::random};
    const auto dealt = colors_of(by_slot, points);
    EXPECT_EQ(dealt[0], kRed);
    EXPECT_EQ(dealt[4], kGreen);
    EXPECT_EQ(dealt[299], kBlue);
    const auto one = colors_of(random, points), again = colors_of(random, points);
    EXPECT_EQ(one, again);
    EXPECT_NE(one, colors_of(random, points, kSeat, 2));
    for (const Rgb& color : {kRed, kGreen, kBlue}) {
        const auto count = std::count(one.begin(), one.end(), color);
        EXPECT_GT(count, 70);
        EXPECT_LT(count, 130);
    }
}

TEST(Paint, AProjectedPictureIsSeenUprightFromTheSeatWhereverThatIs) {
    // Twice as wide as high, like the picture, and facing the seat.
    const Points points = wall({0, 0, 20}, 20, 10, 8, 4);
    for (const Vec3& seat_m : {Vec3{0, -50, 20}, Vec3{0, -500, 20}}) {
        const auto colors = colors_of(ProjectedPicture{kQuarters}, points, seat_m);
        expect_near(colors[3 * 8 + 0], kRed, 0.01);  // top left
        expect_near(colors[3 * 8 + 7], kGreen, 0.01);
        expect_near(colors[0], kBlue, 0.01);
        expect_near(colors[7], kDark, 0.01);  // transparent
    }
    const auto behind = colors_of(ProjectedPicture{kQuarters}, points, {0, 50, 20});
    expect_near(behind[3 * 8 + 7], kRed, 0.01);  // from behind, left and right change places
}

/// Perspective: of a floor that runs away from the seat, the lower half of what is seen is the nearest third.
TEST(Paint, AProjectedPictureFollowsPerspective) {
    Points points;
    for (int i = 0; i <= 200; ++i) points.emplace_back(0, 0.5 * i, 0);
    const Vec3 seat_m{0, -20, 30};
    const auto colors = colors_of(ProjectedPicture{kQuarters}, points, seat_m);
    // By hand: the ray of the middle of what is seen, between the rays to the ends, on a plane that faces y = 50.
    const auto height_seen = [&](double y) {
        const Vec3 ahead = glm::normalize(Vec3{0, 50, 0} - seat_m), up{0, -ahead.z, ahead.y};
        const Vec3 d = Vec3{0, y, 0} - seat_m;
        return glm::dot(d, up) / glm::dot(d, ahead);
    };
    const double middle = 0.5 * (height_seen(0) + height_seen(100));
    for (int i = 0; i <= 200; ++i) {
        const double off = height_seen(0.5 * i) - middle;
        if (std::abs(off) < 0.05) continue;
        // A line is in the picture's middle, where left and right meet: above red and green, below blue and nothing.
        const Rgb& c = colors[static_cast<std::size_t>(i)];
        EXPECT_NEAR(c.b, off > 0.0 ? 0.0 : 0.5, 0.02) << i;
        EXPECT_NEAR(c.r, off > 0.0 ? 0.5 : 0.0, 0.02) << i;
    }
    EXPECT_GT(height_seen(35.0), middle);
}

TEST(Paint, DegeneratePlacesHaveColors) {
    for (const Points& points : {Points{{0, 0, 20}}, Points(5, kSeat), Points{{0, -200, 1.7}, {0, 300, 1.7}}}) {
        for (const Rgb& c : colors_of(ProjectedPicture{kQuarters}, points)) EXPECT_TRUE(c.r >= 0.0 && c.r <= 1.0);
        EXPECT_EQ(colors_of(Gradient{{kRed, kBlue}}, {points.front()}).front(), kRed);
    }
    EXPECT_TRUE(colors_of(ProjectedPicture{kQuarters}, {}).empty());
}

TEST(Paint, FormationsTakeTheirPartsPaint) {
    Part line = part_of(shape(ShapeKind::line), 11, wide(40));
    line.color = Gradient{{kRed, kBlue}, {1, 0, 0}, false};
    Part plain = part_of(shape(ShapeKind::line), 11, wide(40));
    plain.center_m = {0, 10, 0};
    plain.color = kGreen;
    Mission mission = mission_of({line, plain});
    mission.keyframes[0].rotate_rad = {0, 0, 3.14159265358979};  // directions are the show's, not the figure's
    auto built = build(mission);
    const Formation formation = std::move(built).value();
    std::size_t left = 0;
    for (std::size_t i = 1; i < 11; ++i)
        if (formation.points_m[i].x < formation.points_m[left].x) left = i;
    EXPECT_EQ(formation.colors[left], kRed);
    for (std::size_t i = 11; i < 22; ++i) EXPECT_EQ(formation.colors[i], kGreen);
    mission.keyframes[0].parts[0].color = ProjectedPicture{"nowhere.png"};
    const auto refused = build(mission);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::io);
    EXPECT_THAT(refused.error().message,
                HasSubstr("show.toml:7: keyframe[1].part[1].color.image = \"nowhere.png\": cannot be read"));
}

}  // namespace
}  // namespace aerogram::planner::testing
