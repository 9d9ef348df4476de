#include "planner/light/effects.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "geo/random.hpp"
#include "geo/units.hpp"

namespace aerogram::planner {
namespace {

constexpr Rgb kRed{1, 0, 0}, kGreen{0, 1, 0}, kBlue{0, 0, 1};

Light light_of(LightEffect effect, std::vector<Rgb> colors = {kRed}) {
    Light light;
    light.effect = effect;
    light.colors = std::move(colors);
    return light;
}

void expect_near(const Rgb& a, const Rgb& b) {
    EXPECT_NEAR(a.r, b.r, 1e-12);
    EXPECT_NEAR(a.g, b.g, 1e-12);
    EXPECT_NEAR(a.b, b.b, 1e-12);
}

TEST(Fade, CoversMoreAndMoreThenGoesOnThroughItsColors) {
    const Light one = light_of(LightEffect::fade), three = light_of(LightEffect::fade, {kRed, kGreen, kBlue});
    EXPECT_DOUBLE_EQ(fade_glow(one, 0.0).share, 0.0);
    EXPECT_DOUBLE_EQ(fade_glow(one, 0.3).share, 0.3);
    EXPECT_DOUBLE_EQ(fade_glow(one, 1.0).share, 1.0);
    EXPECT_NEAR(fade_glow(three, 1.0 / 6.0).share, 0.5, 1e-12);
    EXPECT_EQ(fade_glow(three, 1.0 / 6.0).color, kRed);
    expect_near(fade_glow(three, 0.5).color, mix(kRed, kGreen, 0.5));
    EXPECT_DOUBLE_EQ(fade_glow(three, 0.5).share, 1.0);
    EXPECT_EQ(fade_glow(three, 1.0).color, kBlue);
}

TEST(Rounds, TheEndOfARoundIsSeenFromBeforeIt) {
    EXPECT_EQ(rounds_at(3.0, 3.0, 2.0).round, 1);
    EXPECT_DOUBLE_EQ(rounds_at(3.0, 3.0, 2.0).share, 0.5);
    EXPECT_EQ(rounds_at(4.0, 4.0, 2.0).round, 2);
    EXPECT_DOUBLE_EQ(rounds_at(4.0, 4.0, 2.0).share, 0.0);
    EXPECT_EQ(rounds_at(4.0, 3.96, 2.0).round, 1);
    EXPECT_DOUBLE_EQ(rounds_at(4.0, 3.96, 2.0).share, 1.0);
}

TEST(Sweep, TheBandsMiddleIsWhereTheTimeSays) {
    Light light = light_of(LightEffect::sweep, {kRed, kGreen});
    light.width_m = 4.0;
    for (const double share : {0.0, 0.25, 0.5, 0.9, 1.0}) {
        const double middle_m = -12.0 + share * 24.0;  // from -10 to 10, and half a band on either side
        const auto at = [&](double off_m) {
            return sweep_glow(light, middle_m + off_m, -10.0, 10.0, {0, share}).share;
        };
        EXPECT_NEAR(at(0.0), 1.0, 1e-12);
        EXPECT_NEAR(at(1.0), 0.5, 1e-12);
        EXPECT_NEAR(at(-1.0), 0.5, 1e-12);
        EXPECT_NEAR(at(0.5), 0.5 + 0.5 * std::cos(kPi / 4.0), 1e-12);
        EXPECT_EQ(at(2.001), 0.0);
    }
    EXPECT_EQ(sweep_glow(light, 0.0, -10.0, 10.0, {0, 0.5}).color, kRed);
    EXPECT_EQ(sweep_glow(light, 0.0, -10.0, 10.0, {1, 0.5}).color, kGreen);
    EXPECT_EQ(sweep_glow(light, 0.0, -10.0, 10.0, {2, 0.5}).color, kRed);
}

TEST(Sweep, NobodyIsCoveredWhereARoundBeginsAndEnds) {
    Light light = light_of(LightEffect::sweep);
    for (const double way_m : {-10.0, -3.0, 10.0}) {
        EXPECT_NEAR(sweep_glow(light, way_m, -10.0, 10.0, {0, 0.0}).share, 0.0, 1e-12);
        EXPECT_NEAR(sweep_glow(light, way_m, -10.0, 10.0, {0, 1.0}).share, 0.0, 1e-12);
    }
}

TEST(Chase, TheRunIsAsLongAsAskedForAndGoesRoundOnceAPeriod) {
    Light light = light_of(LightEffect::chase);
    light.length = 3;
    constexpr std::size_t kCount = 10;
    for (std::size_t step = 0; step <= 20; ++step) {
        const double rounds = static_cast<double>(step) / 10.0;
        double covered = 0.0;
        for (std::size_t place = 0; place < kCount; ++place) {
            // The head has passed `step` places: the run holds the three before it.
            const std::size_t behind = (step + 2 * kCount - 1 - place) % kCount;
            const double share = chase_glow(light, place, kCount, rounds).share;
            EXPECT_NEAR(share, behind < 3 ? 1.0 : 0.0, 1e-9) << step << ' ' << place;
            covered += share;
        }
        EXPECT_NEAR(covered, 3.0, 1e-9);
    }
    // Between two places both are covered in part.
    EXPECT_NEAR(chase_glow(light, 5, kCount, 0.54).share, 0.4, 1e-9);
    EXPECT_NEAR(chase_glow(light, 2, kCount, 0.54).share, 0.6, 1e-9);
}

TEST(Chase, HasOneRunForEachColor) {
    Light light = light_of(LightEffect::chase, {kRed, kBlue});
    light.length = 2;
    const auto color_at = [&](std::size_t place) { return chase_glow(light, place, 12, 0.5).color; };
    EXPECT_EQ(color_at(5), kRed);
    EXPECT_EQ(color_at(4), kRed);
    EXPECT_EQ(color_at(11), kBlue);
    EXPECT_EQ(color_at(10), kBlue);
    for (const std::size_t dark : {0u, 3u, 6u, 9u}) EXPECT_NEAR(chase_glow(light, dark, 12, 0.5).share, 0.0, 1e-9);
}

TEST(Chase, ARunLongerThanTheFormationCoversItAll) {
    Light light = light_of(LightEffect::chase);
    light.length = 100;
    for (std::size_t place = 0; place < 7; ++place) EXPECT_NEAR(chase_glow(light, place, 7, 0.37).share, 1.0, 1e-9);
}

TEST(Pulse, BreathesOnceARound) {
    const Light light = light_of(LightEffect::pulse, {kRed, kGreen});
    EXPECT_NEAR(pulse_glow(light, {0, 0.0}).share, 0.0, 1e-12);
    EXPECT_NEAR(pulse_glow(light, {0, 0.25}).share, 0.5, 1e-12);
    EXPECT_NEAR(pulse_glow(light, {0, 0.5}).share, 1.0, 1e-12);
    EXPECT_NEAR(pulse_glow(light, {0, 1.0}).share, 0.0, 1e-12);
    EXPECT_EQ(pulse_glow(light, {3, 0.5}).color, kGreen);
}

TEST(Sparkle, TheShareOfDronesIsLitAtEveryTime) {
    Light light = light_of(LightEffect::sparkle);
    light.period_s = 0.5;
    constexpr std::size_t kDrones = 20'000;
    for (const double share : {0.05, 0.2, 0.7, 1.0}) {
        light.share = share;
        for (const double since_s : {0.0, 0.3, 7.7, 61.0}) {
            std::size_t lit = 0;
            for (std::size_t d = 0; d < kDrones; ++d)
                if (sparkle_glow(light, 5, DroneId(d), since_s).share > 0.0) ++lit;
            const double deviation = std::sqrt(share * (1.0 - share) / kDrones);
            EXPECT_NEAR(static_cast<double>(lit) / kDrones, share, 4.0 * deviation + 1e-12) << share << ' ' << since_s;
        }
    }
}

TEST(Sparkle, EachIsLitForOnePeriodInEveryCycle) {
    Light light = light_of(LightEffect::sparkle, {kRed, kBlue});
    light.period_s = 0.4;
    light.share = 0.25;  // cycles of 1.6 s
    std::size_t blue = 0;
    for (std::size_t d = 0; d < 50; ++d) {
        std::size_t lit = 0, changes = 0;
        bool before = false;
        constexpr std::size_t kSteps = 16'000;  // 10 cycles of 1,600
        for (std::size_t step = 0; step < kSteps; ++step) {
            const Glow glow = sparkle_glow(light, 9, DroneId(d), static_cast<double>(step) / 1000.0);
            const bool now = glow.share > 0.0;
            if (now) ++lit;
            if (step > 0 && now != before) ++changes;
            if (now && glow.color == kBlue) ++blue;
            before = now;
        }
        EXPECT_NEAR(static_cast<double>(lit), 4000.0, 420.0);  // whole cycles but for the two at the ends
        EXPECT_GE(changes, 16u);
        EXPECT_LE(changes, 22u);
    }
    EXPECT_NEAR(static_cast<double>(blue) / (50.0 * 4000.0), 0.5, 0.1);
}

TEST(Sparkle, TheSeedDecides) {
    Light light = light_of(LightEffect::sparkle);
    std::size_t different = 0;
    for (std::size_t d = 0; d < 1000; ++d) {
        const double lit = sparkle_glow(light, 1, DroneId(d), 3.0).share;
        EXPECT_EQ(lit, sparkle_glow(light, 1, DroneId(d), 3.0).share);
        if (lit != sparkle_glow(light, 2, DroneId(d), 3.0).share) ++different;
    }
    EXPECT_GT(different, 200u);  // 2 x 0.2 x 0.8 of them, expected
    light.share = 0.0;
    for (std::size_t d = 0; d < 100; ++d) EXPECT_EQ(sparkle_glow(light, 1, DroneId(d), 3.0).share, 0.0);
}

TEST(GradientLight, StandsMovesOrFollowsTime) {
    Light light = light_of(LightEffect::gradient, {kRed, kGreen, kBlue});
    light.period_s = 0.0;
    EXPECT_EQ(gradient_glow(light, -4.0, -4.0, 4.0, 9.0, 0.5).color, kRed);
    expect_near(gradient_glow(light, 2.0, -4.0, 4.0, 9.0, 0.5).color, mix(kGreen, kBlue, 0.5));
    EXPECT_EQ(gradient_glow(light, 4.0, -4.0, 4.0, 9.0, 0.5).color, kBlue);
    light.period_s = 4.0;  // what was at -4 is at 0 two seconds later
    expect_near(gradient_glow(light, 0.0, -4.0, 4.0, 2.0, 0.0).color, kRed);
    expect_near(gradient_glow(light, 1.0, -4.0, 4.0, 2.5, 0.0).color,
                gradient_glow(light, 0.0, -4.0, 4.0, 2.0, 0.0).color);
    light.in_time = true;
    expect_near(gradient_glow(light, 1.0, -4.0, 4.0, 2.0, 0.0).color, mix(kGreen, kBlue, 0.5));
    light.period_s = 0.0;
    EXPECT_EQ(gradient_glow(light, 1.0, -4.0, 4.0, 2.0, 0.0).color, kRed);
    EXPECT_EQ(gradient_glow(light, 1.0, -4.0, 4.0, 2.0, 1.0).color, kBlue);
}

TEST(Blend, IsWhatItIsCalledInLinearLightAndStaysInRange) {
    const Rgb beneath{0.8, 0.4, 0.0};
    const Glow glow{{0.5, 1.0, 0.25}, 0.5};
    expect_near(blended(beneath, glow, LightBlend::replace, 1.0), {0.65, 0.7, 0.125});
    expect_near(blended(beneath, glow, LightBlend::replace, 0.5), {0.725, 0.55, 0.0625});
    expect_near(blended(beneath, {glow.color, 1.0}, LightBlend::multiply, 1.0), {0.4, 0.4, 0.0});
    expect_near(blended(beneath, {glow.color, 1.0}, LightBlend::add, 1.0), {1.0, 1.0, 0.25});
    EXPECT_EQ(blended(beneath, {glow.color, 0.0}, LightBlend::add, 1.0), beneath);
    Random random(3);
    for (int i = 0; i < 10'000; ++i) {
        const auto color = [&] { return Rgb{random.unit(), random.unit(), random.unit()}; };
        const auto blend = static_cast<LightBlend>(random.below(3));
        const Rgb out = blended(color(), {color(), random.unit()}, blend, random.unit());
        for (const double c : {out.r, out.g, out.b}) ASSERT_TRUE(c >= 0.0 && c <= 1.0);
    }
}

}  // namespace
}  // namespace aerogram::planner
