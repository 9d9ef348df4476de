#include "planner/light/lights.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geo/units.hpp"
#include "planner/light/effects.hpp"
#include "planner/light/key_writer.hpp"
#include "stages.hpp"

namespace aerogram::planner {
namespace {

using namespace test;
using ::testing::HasSubstr;

constexpr double kNear = kLightTolerance + 1e-9;

void expect_color(const Rgb& actual, const Rgb& expected, double tolerance = kNear) {
    EXPECT_NEAR(actual.r, expected.r, tolerance);
    EXPECT_NEAR(actual.g, expected.g, tolerance);
    EXPECT_NEAR(actual.b, expected.b, tolerance);
}

TEST(Lights, Property3_WithoutLightsTheTracksStayAsTheyAre) {
    const SmallShow show;
    EXPECT_EQ(show.lit(), show.tracks);
}

TEST(Lights, ASweepsBandIsWhereItsTimeSays) {
    SmallShow show;
    Light& light = show.add_light(LightEffect::sweep, "row", {kRed});
    light.width_m = 4.0;
    light.period_s = 5.0;
    const auto tracks = show.lit();
    for (const double t_s : {20.0, 21.0, 22.52, 24.2, 26.0, 28.4}) {             // samples: multiples of 40 ms
        const double middle_m = -2.0 + std::fmod(t_s - 20.0, 5.0) / 5.0 * 14.0;  // from -2 to 12
        for (std::size_t d = 0; d < 11; ++d) {
            const double off = std::abs(static_cast<double>(d) - middle_m) / 4.0;
            const double share = off < 0.5 ? 0.5 + 0.5 * std::cos(2.0 * kPi * off) : 0.0;
            expect_color(shown(tracks, d, t_s), mix(kWhite, kRed, share));
        }
    }
    EXPECT_EQ(shown(tracks, 3, 19.9), shown(show.tracks, 3, 19.9));
    EXPECT_EQ(shown(tracks, 3, 30.0), kWhite);
    EXPECT_EQ(shown(tracks, 3, 45.0), kWhite);
}

TEST(Lights, OfAKeyframeBelongToSlotsNotToPlaces) {
    SmallShow show;
    Light& light = show.add_light(LightEffect::gradient, "high", {kRed, kBlue});
    light.period_s = 0.0;
    light.start_s = -5.0;  // while they arrive: the colours of the slots they fly to
    const auto tracks = show.lit();
    for (const double t_s : {35.0, 37.0, 45.0, 49.9}) {
        expect_color(shown(tracks, 0, t_s), kBlue);  // drone 1 flies to the last slot
        expect_color(shown(tracks, 10, t_s), kRed);
        expect_color(shown(tracks, 2, t_s), mix(kRed, kBlue, 0.8));
    }
    EXPECT_EQ(shown(tracks, 0, 34.9), kWhite);
}

TEST(Lights, WithoutAKeyframeTheyFollowThePlan) {
    SmallShow show;
    Light& light = show.add_light(LightEffect::gradient, "", {kRed, kBlue});
    light.period_s = 0.0;
    light.start_s = 20.0;
    const auto tracks = show.lit();
    expect_color(shown(tracks, 0, 25.0), kRed);
    expect_color(shown(tracks, 0, 45.0), kBlue);  // drone 1 is at the other end by now
    for (const double t_s : {32.0, 33.48, 34.24, 36.0, 38.2}) {
        Points here_m(11);
        positions(show.acts[3], t_s - 30.0, here_m);
        const auto [low, high] = std::ranges::minmax(here_m, {}, &Vec3::x);
        for (std::size_t d = 0; d < 11; ++d)
            expect_color(shown(tracks, d, t_s), mix(kRed, kBlue, (here_m[d].x - low.x) / (high.x - low.x)));
    }
}

/// With a volume a gradient stands in the show: a drone's colour is that of the place it flies through.
TEST(Lights, WithAVolumeAGradientStandsInTheShow) {
    SmallShow show;
    Light& light = show.add_light(LightEffect::gradient, "", {kRed, kBlue});
    light.period_s = 0.0;
    light.start_s = 20.0;
    light.volume = LightVolume{{0, 0, 30}, Vec3{200, 200, 200}, {}};  // x from -100 to 100
    const auto tracks = show.lit();
    for (const double t_s : {25.0, 32.0, 34.24, 38.2, 45.0}) {
        Points here_m(11);
        const std::size_t act = t_s < 30.0 ? 2 : t_s < 40.0 ? 3 : 4;
        positions(show.acts[act], t_s - seconds_from_ms(show.acts[act].start_ms), here_m);
        for (std::size_t d = 0; d < 11; ++d)
            expect_color(shown(tracks, d, t_s), mix(kRed, kBlue, (here_m[d].x + 100.0) / 200.0));
    }
}

TEST(Lights, LaterOnesLieOverEarlierOnesAndBlend) {
    SmallShow show;
    const auto plain = [&](const Rgb& color, LightBlend blend) -> Light& {
        Light& light = show.add_light(LightEffect::gradient, "row", {color});
        light.in_time = true;
        light.blend = blend;
        return light;
    };
    plain({0.2, 0.4, 0.6}, LightBlend::replace);
    EXPECT_EQ(shown(show.lit(), 0, 25.0), (Rgb{0.2, 0.4, 0.6}));
    plain({0.5, 0.5, 0.5}, LightBlend::multiply);
    expect_color(shown(show.lit(), 0, 25.0), {0.1, 0.2, 0.3}, 1e-12);
    plain({0.5, 0.9, 0.0}, LightBlend::add).opacity = 0.5;
    expect_color(shown(show.lit(), 0, 25.0), {0.35, 0.6, 0.3}, 1e-12);
    plain({0.0, 0.0, 1.0}, LightBlend::replace);
    EXPECT_EQ(shown(show.lit(), 0, 25.0), kBlue);
    std::swap(show.mission.lights[2], show.mission.lights[3]);
    expect_color(shown(show.lit(), 0, 25.0), {0.25, 0.45, 1.0}, 1e-12);
}

TEST(Lights, FadeInAndOutAreRampsOfOpacity) {
    SmallShow show;
    Light& light = show.add_light(LightEffect::gradient, "row", {kRed});
    light.in_time = true;
    light.fade_in_s = 2.0;
    light.fade_out_s = 4.0;
    const auto tracks = show.lit();
    expect_color(shown(tracks, 0, 20.5), mix(kWhite, kRed, 0.25));
    expect_color(shown(tracks, 0, 24.0), kRed);
    expect_color(shown(tracks, 0, 29.0), mix(kWhite, kRed, 0.25));
    const std::vector<LightKey> expected{{0, kDark, false},      {10'000, kDark, true}, {20'000, kWhite, true},
                                         {22'000, kRed, false},  {26'000, kRed, true},  {30'000, kWhite, false},
                                         {50'000, kWhite, true}, {60'000, kDark, false}};
    EXPECT_EQ(tracks[0].lights, expected);  // each ramp is one fade
}

TEST(Lights, AFadeStaysUntilItsFormationLeavesAndThenGoesOver) {
    SmallShow show;
    show.add_light(LightEffect::fade, "row", {kRed}).duration_s = 4.0;
    auto tracks = show.lit();
    expect_color(shown(tracks, 0, 22.0), mix(kWhite, kRed, 0.5));
    expect_color(shown(tracks, 0, 24.0), kRed);
    expect_color(shown(tracks, 0, 30.0), kRed);
    expect_color(shown(tracks, 0, 35.0), mix(kWhite, kRed, 0.5));
    EXPECT_EQ(shown(tracks, 0, 40.0), kWhite);
    show.mission.lights[0].fade_out_s = 1.0;
    tracks = show.lit();
    expect_color(shown(tracks, 0, 23.48), mix(kWhite, kRed, 3.48 / 4.0 * 0.52));
    EXPECT_EQ(shown(tracks, 0, 24.0), kWhite);
}

TEST(Lights, GroupsAndVolumesAreMasks) {
    SmallShow show;
    Group group;
    group.drones = {DroneId(6), DroneId(7), DroneId(8)};
    show.mission.groups = {group};
    Light& grouped = show.add_light(LightEffect::gradient, "row", {kRed, kBlue});
    grouped.period_s = 0.0;
    grouped.group = 0;
    auto tracks = show.lit();
    expect_color(shown(tracks, 6, 25.0), kRed);  // the gradient spans the group
    expect_color(shown(tracks, 7, 25.0), mix(kRed, kBlue, 0.5));
    EXPECT_EQ(tracks[5], show.tracks[5]);
    show.mission.lights.clear();
    Light& ball = show.add_light(LightEffect::gradient, "row", {kRed});
    ball.in_time = true;
    ball.volume = LightVolume{{2, 0, 0}, {}, 1.5};  // from the barycentre, x = 5
    tracks = show.lit();
    for (std::size_t d = 0; d < 11; ++d) EXPECT_EQ(shown(tracks, d, 25.0), d >= 6 && d <= 8 ? kRed : kWhite) << d;
    show.mission.lights[0].volume = LightVolume{{2, 0, 0}, Vec3{2, 1, 1}, {}};
    tracks = show.lit();
    for (std::size_t d = 0; d < 11; ++d) EXPECT_EQ(shown(tracks, d, 25.0), d >= 6 && d <= 8 ? kRed : kWhite) << d;
}

TEST(Lights, AVolumeInTheShowLightsWhoPassesThroughIt) {
    SmallShow show;
    Light& slab = show.add_light(LightEffect::gradient, "", {kRed});
    slab.in_time = true;
    slab.volume = LightVolume{{5, 0, 30}, Vec3{100, 100, 5}, {}};
    const auto tracks = show.lit();
    for (int i = 0; i < 10'000 / 40; ++i) {
        const double t_s = 30.0 + 0.04 * i;
        Points here_m(11);
        positions(show.acts[3], t_s - 30.0, here_m);
        if (std::abs(std::abs(here_m[4].z - 30.0) - 2.5) < 1e-6) continue;
        EXPECT_EQ(shown(tracks, 4, t_s + 0.001), std::abs(here_m[4].z - 30.0) < 2.5 ? kRed : kWhite) << t_s;
    }
    EXPECT_LE(tracks[4].lights.size(), show.tracks[4].lights.size() + 6);  // steps, not samples
}

TEST(Lights, LampsStayDarkOnTheGround) {
    SmallShow show;
    Light& light = show.add_light(LightEffect::sparkle, "", {kRed});
    light.share = 1.0;
    light.start_s = 0.0;
    light.duration_s = 100.0;
    const auto tracks = show.lit();
    EXPECT_EQ(lamp_time(show.acts), (TimeSpan{10'000, 60'000}));
    for (const double t_s : {0.0, 5.0, 9.99, 60.0, 65.0, 100.0}) EXPECT_EQ(shown(tracks, 0, t_s), kDark) << t_s;
    for (const double t_s : {10.0, 15.0, 30.0, 59.99}) EXPECT_EQ(shown(tracks, 0, t_s), kRed) << t_s;
}

TEST(Lights, SpareDronesStayDark) {
    SmallShow show;
    show.keyframes[0].spare.assign(11, false);
    show.keyframes[0].spare[10] = true;  // drone 11 waits, far away
    show.keyframes[0].formation_m[10] = {500, 0, 3};
    for (LightKey& key : show.tracks[10].lights)
        if (key.time_ms == 20'000 || key.time_ms == 30'000) key.color = kDark;
    Light& own = show.add_light(LightEffect::gradient, "row", {kRed, kBlue});
    own.period_s = 0.0;
    Light& all = show.add_light(LightEffect::gradient, "", {kGreen});
    all.in_time = true;
    all.start_s = 26.0;
    const auto tracks = show.lit();
    expect_color(shown(tracks, 9, 25.0), kBlue);  // the spare does not count
    EXPECT_EQ(shown(tracks, 10, 25.0), kDark);
    EXPECT_EQ(shown(tracks, 10, 29.0), kDark);
    EXPECT_EQ(shown(tracks, 9, 29.0), kGreen);
    const Rgb halfway = shown(tracks, 10, 35.0);  // half present, over half of white
    expect_color(halfway, mix({0.5, 0.5, 0.5}, kGreen, 0.5));
    EXPECT_EQ(shown(tracks, 10, 45.0), kGreen);
}

TEST(Lights, ChasesRunAlongSlotsOrAlongTheirDirection) {
    SmallShow show;
    Light& light = show.add_light(LightEffect::chase, "high", {kRed});
    light.length = 2;
    light.period_s = 11.0 * 0.4;
    auto tracks = show.lit();
    for (std::size_t step = 1; step < 11; ++step) {
        for (std::size_t slot = 0; slot < 11; ++slot) {
            const bool lit = slot + 1 == step || slot + 2 == step || (step == 1 && slot == 10);
            expect_color(shown(tracks, 10 - slot, 40.0 + 0.4 * static_cast<double>(step)), lit ? kRed : kWhite);
        }
    }
    show.mission.lights[0].direction = Vec3{-1, 0, 0};
    tracks = show.lit();
    expect_color(shown(tracks, 0, 40.8), kRed);  // the drone at the right, x = 10, comes first
    expect_color(shown(tracks, 1, 40.8), kRed);
    expect_color(shown(tracks, 2, 40.8), kWhite);
}

/// quarters.png: red | green above blue | transparent.
std::filesystem::path picture(const char* name) {
    return std::filesystem::path(AEROGRAM_SOURCE_DIR) / "tests/unit/planner/formation/pictures" / name;
}

/// Drones 1 to 8 as a wall, 4 x 2, twice as wide as high.
SmallShow wall() {
    SmallShow show(8);
    for (std::size_t d = 0; d < 8; ++d)
        show.keyframes[0].formation_m[d] = {10.0 * static_cast<double>(d % 4), 0.0, d < 4 ? 20.0 : 35.0};
    return show;
}

TEST(Lights, AnImageLiesOverTheFormationsBoxAndItsAlphaCovers) {
    SmallShow show = wall();
    show.add_light(LightEffect::image, "row", {kWhite}).images = {picture("quarters.png")};
    const auto tracks = show.lit();
    EXPECT_EQ(shown(tracks, 4, 25.0), kRed);
    EXPECT_EQ(shown(tracks, 7, 25.0), kGreen);
    EXPECT_EQ(shown(tracks, 0, 25.0), kBlue);
    EXPECT_EQ(shown(tracks, 3, 25.0), kWhite);  // transparent: what is beneath
}

TEST(Lights, AnImagesPlaneMayHaveASizeOfItsOwn) {
    SmallShow show = wall();
    Light& light = show.add_light(LightEffect::image, "row", {kWhite});
    light.images = {picture("quarters.png")};
    light.image_size_m = {12.0, 40.0};  // the outer columns, 15 m from the middle, are beside it
    const auto tracks = show.lit();
    EXPECT_EQ(shown(tracks, 4, 25.0), kWhite);
    EXPECT_EQ(shown(tracks, 5, 25.0), kRed);
    EXPECT_EQ(shown(tracks, 6, 25.0), kGreen);
    EXPECT_EQ(shown(tracks, 1, 25.0), kBlue);
}

TEST(Lights, ASequenceOfImagesPlaysOnceInItsTimeBySteps) {
    SmallShow show = wall();
    Light& light = show.add_light(LightEffect::image, "row", {kWhite});
    const std::filesystem::path banner =
        std::filesystem::path(AEROGRAM_SOURCE_DIR) / "missions/assets/banner.png";  // sky, sun and sea
    light.images = {picture("quarters.png"), banner, picture("quarters.png"), picture("quarters.png")};
    light.duration_s = 8.0;
    const auto tracks = show.lit();
    EXPECT_EQ(shown(tracks, 7, 21.98), kGreen);
    EXPECT_NE(shown(tracks, 7, 22.0), kGreen);
    EXPECT_EQ(shown(tracks, 7, 22.0), shown(tracks, 7, 23.98));
    EXPECT_EQ(shown(tracks, 7, 24.0), kGreen);
    EXPECT_EQ(shown(tracks, 7, 27.98), kGreen);
    EXPECT_EQ(shown(tracks, 7, 28.0), kWhite);
    EXPECT_EQ(tracks[7].lights.size(), 9U);  // 0, 10, 20 twice (white, then green), 22, 24, 28, 50, 60
}

TEST(Lights, AnImageWithoutAKeyframeStandsInItsVolumeOrFollowsTheFleet) {
    SmallShow show;
    Light& light = show.add_light(LightEffect::image, "", {kWhite});
    light.images = {picture("quarters.png")};
    light.image_size_m = {12.0, 12.0};
    light.start_s = 20.0;
    const auto following = show.lit();
    for (const double t_s : {25.0, 36.0, 45.0}) {  // drones 1 and 11 change sides
        const bool before = t_s < 35.0;
        EXPECT_EQ(shown(following, before ? 0 : 10, t_s), shown(following, 0, 25.0)) << t_s;
    }
    show.mission.lights[0].volume = LightVolume{{5, 0, 37}, Vec3{100, 100, 100}, {}};
    const auto standing = show.lit();
    EXPECT_EQ(shown(standing, 0, 25.0), kWhite);  // 17 m below its middle
    EXPECT_EQ(shown(standing, 10, 45.0), kRed);   // 3 m above, at the left
    EXPECT_EQ(shown(standing, 0, 45.0), kGreen);
}

TEST(Lights, FramesOfAnAnimationAreOneFormationThatChanges) {
    SmallShow show;
    show.mission.keyframes[0].name = "wings 1";
    show.mission.keyframes[1].name = "wings 2";
    for (Keyframe& keyframe : show.mission.keyframes) keyframe.clip = "wings";
    Light& light = show.add_light(LightEffect::gradient, "wings", {kRed, kBlue});
    light.period_s = 0.0;
    const auto tracks = show.lit();
    expect_color(shown(tracks, 2, 25.0), mix(kRed, kBlue, 0.2));
    expect_color(shown(tracks, 2, 45.0), mix(kRed, kBlue, 0.8));
    // On the way: slots x = 2 to 8 by straight lines, of a formation that stays from 0 to 10.
    expect_color(shown(tracks, 2, 35.0), mix(kRed, kBlue, 0.5));
    EXPECT_EQ(shown(tracks, 2, 50.0), kWhite);
}

TEST(Lights, ACarrierThatTurnsTurnsDirectionsToo) {
    SmallShow show;
    for (Vec3& p : show.keyframes[0].formation_m) p = {-p.y, p.x, p.z};  // a quarter turn
    show.keyframes[0].turned_rad = 0.5 * kPi;
    Light& light = show.add_light(LightEffect::gradient, "row", {kRed, kBlue});
    light.period_s = 0.0;
    const auto tracks = show.lit();
    expect_color(shown(tracks, 0, 25.0), kRed);
    expect_color(shown(tracks, 7, 25.0), mix(kRed, kBlue, 0.7));
}

TEST(Lights, Property1And2_ThreadsChangeNothingAndTheSeedDecides) {
    SmallShow show(40);
    show.add_light(LightEffect::sparkle, "", {kRed, kBlue, kGreen}).start_s = 12.0;
    show.add_light(LightEffect::sweep, "row", {kBlue}).blend = LightBlend::add;
    show.add_light(LightEffect::pulse, "high", {kRed, kGreen}).opacity = 0.7;
    const auto tracks = show.lit(1);
    EXPECT_EQ(show.lit(2), tracks);
    EXPECT_EQ(show.lit(7), tracks);
    show.mission.seed = 2;
    EXPECT_NE(show.lit(1), tracks);
}

/// All times are light ticks in order, all colours in range: what formats need.
TEST(Lights, KeysAreInOrderOnTicksAndInRange) {
    SmallShow show(30);
    show.mission.light_rate_hz = 50.0;
    for (const LightEffect effect : {LightEffect::sweep, LightEffect::chase, LightEffect::pulse, LightEffect::sparkle})
        show.add_light(effect, effect == LightEffect::pulse ? "high" : "", {kRed, kBlue}).blend = LightBlend::add;
    for (const Tracks& track : show.lit()) {
        for (std::size_t k = 0; k < track.lights.size(); ++k) {
            const LightKey& key = track.lights[k];
            ASSERT_EQ(key.time_ms % 20, 0);
            ASSERT_TRUE(k == 0 || track.lights[k - 1].time_ms <= key.time_ms);
            for (const double c : {key.color.r, key.color.g, key.color.b}) ASSERT_TRUE(c >= 0.0 && c <= 1.0);
        }
    }
}

TEST(Lights, WhatCannotBeSeenIsAnError) {
    SmallShow show;
    Light& light = show.add_light(LightEffect::pulse, "row", {kRed});
    light.start_s = 10.5;
    EXPECT_THAT(show.refusal().message, HasSubstr("show.toml:12: light[1]: ends before it begins"));
    light.keyframe = "";
    light.start_s = 65.0;
    EXPECT_THAT(show.refusal().message, HasSubstr("lamps shine from 10 to 60 s"));
    light.start_s = 2.0;
    light.duration_s = 3.0;
    EXPECT_THAT(show.refusal().message, HasSubstr("light[1]: is over before lamps shine"));
    light.keyframe = "column";
    EXPECT_THAT(show.refusal().message, HasSubstr("no keyframe is called so"));
    light.keyframe = "row";
    light.effect = LightEffect::image;
    light.images = {"nowhere.png"};
    EXPECT_EQ(show.refusal().code, ErrorCode::io);
    EXPECT_THAT(show.refusal().message, HasSubstr("light[1].image = \"nowhere.png\": cannot be read"));
}

}  // namespace
}  // namespace aerogram::planner
