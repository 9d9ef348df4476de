#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "export/verify/judge.hpp"
#include "tests/unit/export/verify/judged.hpp"
#include "tests/unit/export/verify/shows.hpp"

namespace aerogram::exporter {
namespace {

using testing::add_piece;
using testing::add_smooth;
using testing::airspace;
using testing::broken;
using ::testing::ElementsAre;
using testing::finding;
using testing::judged;
using testing::limits;
using testing::polyline;
using testing::show_of;
using ::testing::UnorderedElementsAre;

// Minimum-jerk moves: peak speed 15/8 D/T, peak acceleration 10/sqrt(3) D/T².
constexpr double kPeakSpeed = 15.0 / 8.0;
const double kPeakAcceleration = 10.0 / std::sqrt(3.0);

/// Straight up to 20 m in 16 s, `way` in 10 s, straight down in 20 s.
RecordedDrone flight(const Vec3& home_m, const Vec3& way_m = {20, 0, 0}) {
    RecordedDrone drone;
    const Vec3 up = home_m + Vec3{0, 0, 20}, there = up + way_m, landed{there.x, there.y, home_m.z};
    add_smooth(drone, 16.0, home_m, up);
    add_smooth(drone, 10.0, up, there);
    add_smooth(drone, 20.0, there, landed);
    drone.home_m = home_m;
    drone.land_m = landed;
    return drone;
}
RecordedShow legal() {
    return show_of({flight({0, 0, 0}), flight({0, 5, 0})});
}

constexpr Limits kAnyAltitude{.min_navigation_altitude_m = 0.0};

// One piece of a millisecond made a reader state an allowance of 20,000 m/s²: nothing that any drone did counted.
TEST(Judge, RoundingExcusesAPartOfALimitNeverAllOfIt) {
    RecordedShow show = show_of({flight({0, 0, 0}, {80, 0, 0})});
    show.rounding.speed_allowance_mps = 5.3;
    show.rounding.acceleration_allowance_mps2 = 20'785.0;
    const Judgement judgement = judged(show);
    EXPECT_FALSE(finding(judgement, "speed_horizontal").held);
    EXPECT_FALSE(finding(judgement, "acceleration").held);
}

TEST(Judge, LegalShowHoldsEveryRuleThatApplies) {
    const Judgement judgement = judged(legal());
    EXPECT_TRUE(judgement.held());
    EXPECT_EQ(judgement.limits_from, "preset standard");
    EXPECT_TRUE(judgement.separation_claimed);
    std::vector<std::string> rules;
    for (const Finding& each : judgement.findings) rules.push_back(each.rule);
    EXPECT_THAT(rules,
                ElementsAre("separation", "speed_horizontal", "speed_up", "speed_down", "acceleration", "velocity_jump",
                            "position_jump", "altitude_max", "altitude_min", "altitude_min_navigation", "pads"));
    EXPECT_NEAR(finding(judgement, "speed_horizontal").worst, kPeakSpeed * 2.0, 2e-6);
    EXPECT_NEAR(finding(judgement, "speed_horizontal").time_s.value(), 21.0, 1e-3);
    EXPECT_NEAR(finding(judgement, "speed_up").worst, kPeakSpeed * 20.0 / 16.0, 2e-6);
    EXPECT_NEAR(finding(judgement, "speed_down").worst, kPeakSpeed, 2e-6);
    EXPECT_NEAR(finding(judgement, "acceleration").worst, kPeakAcceleration * 0.2, 2e-6);
    EXPECT_NEAR(finding(judgement, "altitude_max").worst, 20.0, 2e-6);
    EXPECT_EQ(finding(judgement, "pads").worst, 0.0);
}

TEST(Judge, LimitsComeFromTheFileThenFromOutsideThenFromThePreset) {
    RecordedShow show = legal();
    JudgeAgainst against = limits({.ceiling_m = 70.0});
    against.limits_from = "manifest.json";
    EXPECT_EQ(judged(show, against).limits_from, "manifest.json");
    EXPECT_EQ(finding(judged(show, against), "altitude_max").limit, 70.0);
    show.limits = Limits{.ceiling_m = 60.0};
    EXPECT_EQ(judged(show, against).limits_from, "the file");
    EXPECT_EQ(finding(judged(show, against), "altitude_max").limit, 60.0);
}

TEST(Judge, SeparationHasNoAllowance) {
    RecordedShow show = show_of({flight({0, 0, 0}), flight({0, 1.5, 0})});
    show.rounding.position_m = 0.5;
    EXPECT_TRUE(judged(show).held());
    show = show_of({flight({0, 0, 0}), flight({0, 1.499, 0})});
    show.rounding.position_m = 0.5;
    const Judgement judgement = judged(show);
    EXPECT_THAT(broken(judgement), ElementsAre("separation"));
    const Finding& found = finding(judgement, "separation");
    EXPECT_NEAR(found.worst, 1.499, 1e-6);
    EXPECT_EQ(found.allowance, 0.0);
    EXPECT_THAT(found.drones, ElementsAre(1U, 2U));
    EXPECT_NEAR(judgement.min_separation_m, 1.499, 1e-6);
}

TEST(Judge, SeparationIsResolvedUpToTheClaim) {
    JudgeAgainst against;
    EXPECT_EQ(judged(legal()).min_separation_m, 3.0);
    against.claimed_separation_m = 5.0;
    EXPECT_NEAR(judged(legal(), against).min_separation_m, 5.0, 1e-6);
}

TEST(Judge, EachSpeedIsHeldAtItsLimitAndBrokenBelow) {
    const double horizontal = kPeakSpeed * 2.0, up = kPeakSpeed * 1.25, down = kPeakSpeed;
    const Limits exact{.speed_horizontal_mps = horizontal, .speed_up_mps = up, .speed_down_mps = down};
    EXPECT_TRUE(judged(legal(), limits(exact)).held());
    Limits less = exact;
    less.speed_horizontal_mps -= 1e-4;
    EXPECT_THAT(broken(judged(legal(), limits(less))), ElementsAre("speed_horizontal"));
    less = exact;
    less.speed_up_mps -= 1e-4;
    EXPECT_THAT(broken(judged(legal(), limits(less))), ElementsAre("speed_up"));
    less = exact;
    less.speed_down_mps -= 1e-4;
    EXPECT_THAT(broken(judged(legal(), limits(less))), ElementsAre("speed_down"));
    RecordedShow rounded = legal();
    rounded.rounding.speed_allowance_mps = 1e-4;
    EXPECT_TRUE(judged(rounded, limits(less)).held());
    rounded.rounding.has_speed = false;
    less.speed_down_mps = 0.1;
    EXPECT_TRUE(judged(rounded, limits(less)).held());
}

TEST(Judge, AccelerationIsHeldAtItsLimitAndBrokenBelow) {
    const double peak = kPeakAcceleration * 0.2;
    EXPECT_TRUE(judged(legal(), limits({.acceleration_mps2 = peak})).held());
    const Judgement judgement = judged(legal(), limits({.acceleration_mps2 = peak - 1e-4}));
    EXPECT_THAT(broken(judgement), ElementsAre("acceleration"));
    EXPECT_NEAR(finding(judgement, "acceleration").worst, peak, 2e-6);
    RecordedShow rounded = legal();
    rounded.rounding.acceleration_allowance_mps2 = 1e-4;
    EXPECT_TRUE(judged(rounded, limits({.acceleration_mps2 = peak - 1e-4})).held());
}

TEST(Judge, VelocityJumpsAreAccelerationsWithoutLimit) {
    // Straight lines at 1 m/s: jumps at the start, at the corner and at the end.
    RecordedShow show = show_of({polyline(10.0, {{0, 0, 5}, {10, 0, 5}, {10, 10, 5}})});
    Judgement judgement = judged(show, limits(kAnyAltitude));
    EXPECT_THAT(broken(judgement), ElementsAre("velocity_jump"));
    EXPECT_NEAR(finding(judgement, "velocity_jump").worst, std::sqrt(2.0), 1e-9);
    EXPECT_EQ(finding(judgement, "velocity_jump").time_s, 10.0);
    show.rounding.speed_allowance_mps = 0.5 * std::sqrt(2.0);
    EXPECT_TRUE(judged(show, limits(kAnyAltitude)).held());
    show.rounding.speed_allowance_mps = 0.0;
    show.rounding.has_acceleration = false;
    EXPECT_TRUE(judged(show, limits(kAnyAltitude)).held());
}

TEST(Judge, ShowThatEndsInMotionJumps) {
    RecordedDrone drone;
    add_piece(drone, 10.0, {{0, 0, 5}, {0, 0, 5}, {0, 0, 5}, {3, 0, 5}});
    const Judgement judgement = judged(show_of({drone}), limits(kAnyAltitude));
    EXPECT_THAT(broken(judgement), ElementsAre("velocity_jump"));
    EXPECT_NEAR(finding(judgement, "velocity_jump").worst, 0.9, 1e-9);
}

TEST(Judge, PositionJumpsAreAllowedByRoundingOnly) {
    RecordedDrone drone;
    add_piece(drone, 1.0, {{0, 0, 5}});
    add_piece(drone, 1.0, {{0.01, 0, 5}});
    RecordedShow show = show_of({drone});
    const Judgement judgement = judged(show, limits(kAnyAltitude));
    EXPECT_THAT(broken(judgement), ElementsAre("position_jump"));
    EXPECT_NEAR(finding(judgement, "position_jump").worst, 0.01, 1e-12);
    show.rounding.position_m = 0.003;
    EXPECT_TRUE(judged(show, limits(kAnyAltitude)).held());
}

TEST(Judge, HorizontalMotionBelowTheNavigationAltitudeIsMeasured) {
    // Rises while it goes sideways: 0.25 m have been flown when 2.5 m are reached.
    RecordedShow show = show_of({polyline(10.0, {{0, 0, 0}, {2, 0, 20}, {2, 0, 0}})});
    show.rounding.has_acceleration = false;
    const Judgement judgement = judged(show);
    EXPECT_THAT(broken(judgement), ElementsAre("altitude_min_navigation"));
    EXPECT_NEAR(finding(judgement, "altitude_min_navigation").worst, 0.25, 1e-4);
    EXPECT_NEAR(finding(judgement, "altitude_min_navigation").time_s.value(), 1.25, 1e-3);

    EXPECT_TRUE(judged(legal()).held());
    EXPECT_EQ(finding(judged(legal()), "altitude_min_navigation").worst, 0.0);
}

TEST(Judge, HorizontalMotionJustAtTheNavigationAltitudeIsLegal) {
    const auto at_height = [](double z) {
        RecordedShow show = show_of({polyline(10.0, {{0, 0, 0}, {0, 0, z}, {6, 0, z}, {6, 0, 0}})});
        show.rounding.has_acceleration = false;
        return show;
    };
    EXPECT_TRUE(judged(at_height(2.5)).held());
    EXPECT_TRUE(judged(at_height(2.4991)).held());  // altitudes are judged to a millimetre
    const Judgement judgement = judged(at_height(2.4989));
    EXPECT_THAT(broken(judgement), ElementsAre("altitude_min_navigation"));
    EXPECT_NEAR(finding(judgement, "altitude_min_navigation").worst, 6.0, 1e-6);
    RecordedShow rounded = at_height(2.4989);
    rounded.rounding.position_m = 0.001;
    EXPECT_TRUE(judged(rounded).held());
}

TEST(Judge, StaysBelowTheNavigationAltitudeCountOneByOne) {
    // Two landings 6 m apart, each upright.
    RecordedShow show =
        show_of({polyline(10.0, {{0, 0, 0}, {0, 0, 9}, {6, 0, 9}, {6, 0, 1}, {6, 0, 9}, {0, 0, 9}, {0, 0, 0}})});
    show.rounding.has_acceleration = false;
    EXPECT_TRUE(judged(show).held());
}

TEST(Judge, CeilingIsAboveTheDronesOwnHome) {
    RecordedShow show = show_of({flight({0, 0, 0}), flight({0, 5, 3})});
    EXPECT_TRUE(judged(show, limits({.ceiling_m = 20.0})).held());
    const Judgement judgement = judged(show, limits({.ceiling_m = 19.9}));
    EXPECT_THAT(broken(judgement), ElementsAre("altitude_max"));
    EXPECT_NEAR(finding(judgement, "altitude_max").worst, 20.0, 2e-6);
    show.rounding.position_m = 0.1;
    EXPECT_TRUE(judged(show, limits({.ceiling_m = 19.9})).held());
}

// The planner certified a straight line between two points at the ceiling, the verifier refused it: over the line the
// height above home differs by fractions of a millimetre. Both judge altitudes to 1 mm.
TEST(Judge, AltitudesAreJudgedToAMillimetre) {
    RecordedShow show = show_of({flight({0, 0, 0})});
    EXPECT_TRUE(judged(show, limits({.ceiling_m = 20.0 - 0.0009})).held());
    EXPECT_THAT(broken(judged(show, limits({.ceiling_m = 20.0 - 0.0011}))), ElementsAre("altitude_max"));
    EXPECT_EQ(finding(judged(show), "altitude_max").allowance, 1e-3);

    const geo::ShowFrame frame(geo::ShowOrigin{{35.0, 139.0, 40.0}, 20.0, {}});
    const auto at_altitude = [&](const Vec3& under, double altitude_m) {
        geo::Geodetic place = frame.to_geodetic(under);
        place.height_m = frame.to_geodetic({0, 0, 0}).height_m + altitude_m;
        return frame.to_show(place);
    };
    const Vec3 from = at_altitude({-30, 0, 0}, 20.0), to = at_altitude({40, 50, 0}, 20.0);
    RecordedDrone drone;
    add_smooth(drone, 60.0, {from.x, from.y, 0}, from);
    add_smooth(drone, 60.0, from, to);
    add_smooth(drone, 60.0, to, {to.x, to.y, 0});
    drone.home_m = Vec3{from.x, from.y, 0};
    show = show_of({drone});
    show.origin = frame.origin();
    EXPECT_TRUE(judged(show, limits({.min_navigation_altitude_m = 0.0, .ceiling_m = 20.0})).held());
    EXPECT_TRUE(judged(show, limits({.min_navigation_altitude_m = 20.0})).held());
}

// Nothing once looked below: a drone could fly through the ground.
TEST(Judge, NobodyFliesBelowTheGround) {
    const auto dipping = [](double depth_m) {
        RecordedDrone drone;
        add_smooth(drone, 10.0, {0, 0, 3}, {0, 0, 13});
        add_piece(drone, 20.0, {{0, 0, 13}, {0, 0, 3.0 - 10.0 - 2.0 * depth_m}, {0, 0, 13}});  // lowest in its middle
        add_smooth(drone, 10.0, {0, 0, 13}, {0, 0, 3});
        drone.home_m = drone.land_m = Vec3{0, 0, 3};
        return show_of({flight({20, 20, 0}), drone});
    };
    const Finding fine = finding(judged(legal()), "altitude_min");
    EXPECT_TRUE(fine.held);
    EXPECT_NEAR(fine.worst, 0.0, 2e-6);
    EXPECT_EQ(fine.limit, 0.0);
    EXPECT_EQ(fine.allowance, 0.05);

    RecordedShow show = dipping(1.0);
    const Finding deep = finding(judged(show), "altitude_min");
    EXPECT_FALSE(deep.held);
    EXPECT_NEAR(deep.worst, -1.0, 2e-6);
    EXPECT_LE(deep.worst, -1.0);
    EXPECT_THAT(deep.drones, ElementsAre(2U));
    EXPECT_NEAR(deep.time_s.value(), 20.0, 0.01);
    show.origin = geo::ShowOrigin{{35.0, 139.0, 40.0}, 20.0, {}};
    EXPECT_NEAR(finding(judged(show), "altitude_min").worst, -1.0, 2e-6);
    EXPECT_FALSE(finding(judged(show), "altitude_min").held);

    EXPECT_TRUE(finding(judged(dipping(0.049)), "altitude_min").held);
    show = dipping(0.06);
    EXPECT_FALSE(finding(judged(show), "altitude_min").held);
    show.rounding.position_m = 0.02;
    EXPECT_TRUE(finding(judged(show), "altitude_min").held);
}

TEST(Judge, LandingPlacesMayBeLowerThanHome) {
    RecordedShow show = show_of({polyline(10.0, {{0, 0, 3}, {0, 0, 23}, {9, 0, 23}, {9, 0, 0}})});
    show.drones[0].home_m = Vec3{0, 0, 3};
    EXPECT_NEAR(finding(judged(show), "altitude_min").worst, -3.0, 2e-6);
    show.drones[0].land_m = Vec3{9, 0, 0};
    EXPECT_TRUE(finding(judged(show), "altitude_min").held);
}

TEST(Judge, WithoutAStatedHomeAltitudesCountFromZero) {
    RecordedShow show = show_of({polyline(10.0, {{0, 0, 30}, {0, 0, 50}, {0, 0, 30}})});
    EXPECT_NEAR(finding(judged(show), "altitude_max").worst, 50.0, 2e-6);
    show.drones[0].home_m = Vec3{0, 0, 30};
    EXPECT_NEAR(finding(judged(show), "altitude_max").worst, 20.0, 2e-6);
}

TEST(Judge, EarthsCurvatureCountsInAltitudes) {
    // 1,000 m out at constant show z: 1000² / (2 · 6371 km) = 7.8 cm higher above home.
    RecordedShow show = show_of({flight({0, 0, 0}, {1000, 0, 0})});
    show.origin = geo::ShowOrigin{{35.0, 139.0, 40.0}, 20.0, {}};
    const Finding found = finding(judged(show), "altitude_max");
    const double there = geo::ShowFrame(*show.origin).altitude_above({0, 0, 0}, {1000, 0, 20});
    EXPECT_NEAR(there, 20.0785, 0.001);
    EXPECT_NEAR(found.worst, there, 2e-6);
}

TEST(Judge, GeofenceMarginIsTheSmallestFromInside) {
    // Flies to x = 20; the fence ends at 20.5; an inclined edge is farther.
    geo::Airspace fence{.geofence_m = {{-5, -5}, {20.5, -5}, {20.5, 30}, {-5, 12}}, .audience_m = {}, .obstacles = {}};
    Judgement judgement = judged(legal(), airspace(fence));
    EXPECT_TRUE(judgement.held());
    EXPECT_NEAR(finding(judgement, "geofence").worst, 0.5, 1e-6);
    fence.geofence_m[1].x = fence.geofence_m[2].x = 19.99;
    judgement = judged(legal(), airspace(fence));
    EXPECT_THAT(broken(judgement), ElementsAre("geofence"));
    EXPECT_NEAR(finding(judgement, "geofence").worst, -0.01, 1.5e-3);
    RecordedShow rounded = legal();
    rounded.rounding.fit_m = 0.012;
    EXPECT_TRUE(judged(rounded, airspace(fence)).held());
}

TEST(Judge, GeofenceIsWatchedBetweenTheEndsOfAPiece) {
    // The notch is only 1 m wide and the drone passes it in the middle of one piece.
    const geo::Airspace fence{
        .geofence_m = {{-5, -5}, {9.5, -5}, {9.5, 6}, {10.5, 6}, {10.5, -5}, {30, -5}, {30, 30}, {-5, 30}},
        .audience_m = {},
        .obstacles = {}};
    const Judgement judgement = judged(legal(), airspace(fence));
    EXPECT_THAT(broken(judgement), ElementsAre("geofence"));
    EXPECT_LE(finding(judgement, "geofence").worst, -0.5);
    EXPECT_GE(finding(judgement, "geofence").worst, -0.52);
}

TEST(Judge, NobodyFliesOverTheAudience) {
    geo::Airspace audience{.geofence_m = {},
                           .audience_m = {{{5, 40}, {9, 40}, {9, 50}}, {{8, -9}, {12, -9}, {12, -0.25}, {8, -0.25}}},
                           .obstacles = {}};
    Judgement judgement = judged(legal(), airspace(audience));
    EXPECT_TRUE(judgement.held());
    EXPECT_NEAR(finding(judgement, "audience").worst, 0.25, 1e-6);
    EXPECT_THAT(finding(judgement, "audience").drones, ElementsAre(1U));
    audience.audience_m[1][2].y = audience.audience_m[1][3].y = 0.1;
    EXPECT_THAT(broken(judged(legal(), airspace(audience))), ElementsAre("audience"));
}

TEST(Judge, ObstaclesAreClearedBesideAndAbove) {
    geo::Airspace mast{
        .geofence_m = {}, .audience_m = {}, .obstacles = {{"mast", geo::Cylinder{{10, -4}, 3.0}, 0.0, 25.0}}};
    Judgement judgement = judged(legal(), airspace(mast));
    EXPECT_TRUE(judgement.held());
    EXPECT_NEAR(finding(judgement, "obstacles").worst, 1.0, 2e-4);
    mast.obstacles[0].height_m = 18.5;  // sqrt(1² + 1.5²) away from the rim
    EXPECT_NEAR(finding(judged(legal(), airspace(mast)), "obstacles").worst, std::sqrt(3.25), 2e-4);
    mast.obstacles[0].shape = geo::Prism{{{8, -4}, {12, -4}, {12, 4}, {8, 4}}};
    EXPECT_NEAR(finding(judged(legal(), airspace(mast)), "obstacles").worst, 1.5, 2e-4);
    mast.obstacles[0].height_m = 20.5;
    EXPECT_THAT(broken(judged(legal(), airspace(mast))), ElementsAre("obstacles"));
}

TEST(Judge, PadsAreWhereTheShowStartsAndEnds) {
    RecordedShow show = legal();
    show.drones[1].home_m = Vec3{0, 5, 0.004};
    show.rounding.position_m = 0.002;
    EXPECT_TRUE(judged(show).held());
    show.drones[1].land_m = Vec3{20, 5.5, 0};
    const Judgement judgement = judged(show);
    EXPECT_THAT(broken(judgement), ElementsAre("pads"));
    EXPECT_NEAR(finding(judgement, "pads").worst, 0.5, 1e-9);
    EXPECT_THAT(finding(judgement, "pads").drones, ElementsAre(2U));
    EXPECT_EQ(finding(judgement, "pads").time_s, 46.0);
}

TEST(Judge, EnduranceIsTheWholeShow) {
    JudgeAgainst against;
    against.endurance_s = 46.0;
    EXPECT_TRUE(judged(legal(), against).held());
    against.endurance_s = 45.9;
    EXPECT_THAT(broken(judged(legal(), against)), ElementsAre("endurance"));
}

TEST(Judge, TracksOutOfOrderAreProblems) {
    RecordedShow show = legal();
    show.drones[1].tracks.lights = {{1000, {1, 0, 0}, false}, {980, {0, 1, 0}, false}};
    EXPECT_THAT(judged(show).problems, ElementsAre("drone 2: light keys go back in time after 1000 ms"));
    EXPECT_FALSE(judged(show).held());
    show.drones[1].tracks.lights = {{1000, {1, 0, 1.5}, false}};
    EXPECT_THAT(judged(show).problems, ElementsAre("drone 2: the light at 1000 ms is not within 0..1"));
    show = legal();
    show.duration_s = 40.0;
    EXPECT_THAT(judged(show).problems, ElementsAre("drone 1: flies for 6.000000 s after the show's stated end",
                                                   "drone 2: flies for 6.000000 s after the show's stated end"));
}

TEST(Judge, ShowWithoutDronesIsRefused) {
    const auto result = judge(RecordedShow{}, {}, aerogram::Run{});
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().message, "the show has no drones");
}

TEST(Judge, ThreadsChangeNothing) {
    const Judgement one = judged(legal());
    const Judgement two = judge(legal(), {}, aerogram::Run{.stop = {}, .progress = {}, .threads = 2}).value();
    ASSERT_EQ(one.findings.size(), two.findings.size());
    for (std::size_t i = 0; i < one.findings.size(); ++i) {
        EXPECT_EQ(one.findings[i].worst, two.findings[i].worst);
        EXPECT_EQ(one.findings[i].drones, two.findings[i].drones);
        EXPECT_EQ(one.findings[i].time_s, two.findings[i].time_s);
    }
}

}  // namespace
}  // namespace aerogram::exporter
