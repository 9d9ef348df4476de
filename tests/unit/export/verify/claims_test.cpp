#include "export/verify/claims.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/export/verify/shows.hpp"

namespace aerogram::exporter {
namespace {

using testing::add_smooth;
using testing::Random;
using testing::show_of;

/// Up to 20 m in 16 s, 20 m along +x in 10 s, down in 20 s; a second drone 5 m beside stands still. Minimum-jerk moves:
/// peak speed 15/8 D/T, peak acceleration 10/sqrt(3) D/T², largest jerk 60 D/T³ (at the ends).
RecordedShow show() {
    RecordedDrone flies, stands;
    add_smooth(flies, 16.0, {0, 0, 0}, {0, 0, 20});
    add_smooth(flies, 10.0, {0, 0, 20}, {20, 0, 20});
    add_smooth(flies, 20.0, {20, 0, 20}, {20, 0, 0});
    testing::add_piece(stands, 46.0, {{0, 5, 0}});
    flies.home_m = Vec3{0, 0, 0};
    stands.home_m = Vec3{0, 5, 0};
    return show_of({flies, stands});
}

Rules rules() {
    Rules rules;
    rules.airspace.geofence_m = {{-5, -5}, {25, -5}, {25, 12}, {-5, 12}};
    rules.airspace.audience_m = {{{9, -9}, {11, -9}, {11, -2}, {9, -2}}};
    rules.airspace.obstacles = {{"mast", geo::Cylinder{{10, 9}, 1.0}, 0.0, 50.0}};
    return rules;
}

/// Of the leg along +x, in closed form.
Claims truth() {
    Claims claims;
    claims.begin_s = 16.0;
    claims.end_s = 26.0;
    claims.speed_horizontal_mps = 15.0 / 8.0 * 2.0;
    claims.acceleration_mps2 = 10.0 / std::sqrt(3.0) * 0.2;
    claims.jerk_mps3 = 60.0 * 20.0 / 1000.0;
    claims.altitude_max_m = 20.0;
    claims.geofence_margin_m = 5.0;  // of both drones
    claims.audience_margin_m = 2.0;
    claims.obstacle_margin_m = 8.0;
    return claims;
}

/// Of another leg, with speeds yet to be claimed.
Claims climb_or_descent(double begin_s, double end_s) {
    Claims claims;
    claims.begin_s = begin_s;
    claims.end_s = end_s;
    claims.acceleration_mps2 = claims.jerk_mps3 = 9.0;
    claims.altitude_max_m = 20.0;
    return claims;
}

std::vector<BrokenClaim> broken(const Claims& claims) {
    return broken_claims(show(), rules(), claims, aerogram::Run{});
}

TEST(BrokenClaims, TruthIsNoneAndMilderNeither) {
    Claims claims = truth();
    claims.altitude_min_m = 0.0;
    EXPECT_TRUE(broken(claims).empty());
    claims.speed_up_mps = claims.speed_down_mps = 1.0;
    claims.altitude_min_m = -1.0;
    claims.geofence_margin_m = claims.audience_margin_m = claims.obstacle_margin_m = std::nullopt;
    EXPECT_TRUE(broken(claims).empty());
}

TEST(BrokenClaims, EachIsFoundAloneWithItsTruth) {
    const auto expect = [](const std::string& what, double found, double time_s, std::size_t drone, auto change) {
        SCOPED_TRACE(what);
        Claims claims = truth();
        change(claims);
        const auto all = broken(claims);
        ASSERT_EQ(all.size(), 1U);
        EXPECT_EQ(all[0].what, what);
        EXPECT_EQ(all[0].drone, drone);
        EXPECT_NEAR(all[0].found, found, 2e-6 + 1e-4 * std::abs(found));
        EXPECT_NEAR(all[0].time_s, time_s, 0.05);
    };
    const double peak_s = 16.0 + 10.0 * (0.5 - std::sqrt(3.0) / 6.0);
    expect("max_speed_horizontal_mps", 3.75, 21.0, 0, [](Claims& c) { c.speed_horizontal_mps -= 1e-4; });
    expect("max_acceleration_mps2", 2.0 / std::sqrt(3.0), peak_s, 0, [](Claims& c) { c.acceleration_mps2 -= 1e-4; });
    expect("max_jerk_mps3", 1.2, 16.0, 0, [](Claims& c) { c.jerk_mps3 -= 1e-4; });
    expect("altitude_max_m", 20.0, 16.0, 0, [](Claims& c) { c.altitude_max_m -= 0.0011; });
    expect("altitude_min_m", 0.0, 0.0, 1, [](Claims& c) { c.altitude_min_m += 0.0011; });
    expect("audience_margin_m", 2.0, 21.0, 0, [](Claims& c) { *c.audience_margin_m += 1e-4; });
    expect("obstacle_margin_m", 8.0, 21.0, 0, [](Claims& c) { *c.obstacle_margin_m += 3e-4; });
    expect("max_speed_up_mps", 15.0 / 8.0 * 1.25, 8.0, 0, [](Claims& c) {
        c = climb_or_descent(0.0, 16.0);
        c.speed_up_mps = 2.0;
    });
    expect("max_speed_down_mps", 15.0 / 8.0, 36.0, 0, [](Claims& c) {
        c = climb_or_descent(26.0, 46.0);
        c.speed_down_mps = 1.5;
    });
}

TEST(BrokenClaims, GeofenceOfTheDroneThatIsNearest) {
    Claims claims = truth();
    claims.geofence_margin_m = 5.01;
    const auto all = broken(claims);
    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0].what, "geofence_margin_m");
    EXPECT_NEAR(all[0].found, 5.0, 1e-5);
}

TEST(BrokenClaims, RoundingIsAllowedFor) {
    Claims claims = truth();
    claims.speed_horizontal_mps -= 0.01;
    claims.acceleration_mps2 -= 0.01;
    *claims.audience_margin_m += 0.01;
    EXPECT_EQ(broken(claims).size(), 3U);
    Rules rounded = rules();
    rounded.rounding.speed_allowance_mps = rounded.rounding.acceleration_allowance_mps2 = 0.01;
    rounded.rounding.fit_m = 0.01;
    EXPECT_TRUE(broken_claims(show(), rounded, claims, aerogram::Run{}).empty());
}

/// What dense samples reach may not be claimed to be milder by 1 %; threads change nothing.
TEST(BrokenClaims, DenseSamplesOfRandomCurvesAgree) {
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        RecordedDrone drone;
        Vec3 at{0, 0, 10};
        for (int k = 0; k < 6; ++k) {
            std::vector<Vec3> controls{at};
            for (int i = 0; i < 3; ++i) controls.push_back(at + random.in_box(Vec3(-4.0), Vec3(4.0)));
            at = controls.back();
            testing::add_piece(drone, random.in(0.5, 3.0), controls);
        }
        const RecordedShow one = show_of({drone});
        double across = 0.0, high = -1e9;
        for (int k = 0; k <= 20'000; ++k) {
            const double t = one.duration_s * k / 20'000.0;
            const Vec3 v = velocity_at(drone, t);
            across = std::max(across, std::hypot(v.x, v.y));
            high = std::max(high, position_at(drone, t).z);
        }
        Claims claims;
        claims.end_s = one.duration_s;
        claims.speed_horizontal_mps = 1.01 * across;
        claims.speed_up_mps = claims.speed_down_mps = claims.acceleration_mps2 = claims.jerk_mps3 = 1e6;
        claims.altitude_min_m = -1e6;
        claims.altitude_max_m = high + 0.1;
        EXPECT_TRUE(broken_claims(one, Rules{}, claims, aerogram::Run{}).empty());
        claims.speed_horizontal_mps = 0.99 * across;
        claims.altitude_max_m = high - 0.1;
        for (const unsigned threads : {1U, 2U}) {
            const auto all =
                broken_claims(one, Rules{}, claims, aerogram::Run{.stop = {}, .progress = {}, .threads = threads});
            ASSERT_EQ(all.size(), 2U);
            EXPECT_NEAR(all[0].found, across, 0.005 * across + 1e-6);
            EXPECT_NEAR(all[1].found, high, 0.01);
        }
    }
}

}  // namespace
}  // namespace aerogram::exporter
