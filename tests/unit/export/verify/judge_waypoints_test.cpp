#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "export/verify/judge.hpp"
#include "geo/show_frame.hpp"
#include "tests/unit/export/verify/judged.hpp"
#include "tests/unit/export/verify/shows.hpp"

namespace aerogram::exporter {
namespace {

using testing::airspace;
using testing::broken;
using ::testing::ElementsAre;
using testing::finding;
using testing::judged;
using testing::limits;

/// Take-off to 10 m, a leg 100 m along +x at `height_m`, landing there.
RecordedShow mission(double height_m) {
    RecordedShow show;
    show.format = "plan";
    show.timed = false;
    show.origin = geo::ShowOrigin{{-33.9, 18.4, 12.0}, 70.0, {}};
    const geo::ShowFrame frame(*show.origin);
    RecordedDrone drone;
    drone.home = frame.to_geodetic({0, 0, 0});
    const geo::Geodetic there = frame.to_geodetic({100, 0, 0});
    drone.waypoints = {{*drone.home, height_m, 0.0, Waypoint::Kind::takeoff},
                       {there, height_m, 1.0, Waypoint::Kind::fly_to},
                       {there, 0.0, 0.0, Waypoint::Kind::land}};
    show.drones = {drone};
    return show;
}

TEST(JudgeWaypoints, ClaimNoSeparationAndJudgePlaces) {
    const geo::Airspace fence{.geofence_m = {{-5, -5}, {104, -5}, {104, 5}, {-5, 5}},
                              .audience_m = {{{40, 2}, {60, 2}, {50, 4}}},
                              .obstacles = {}};
    const Judgement judgement = judged(mission(10.0), airspace(fence));
    EXPECT_TRUE(judgement.held());
    EXPECT_FALSE(judgement.separation_claimed);
    EXPECT_NEAR(finding(judgement, "geofence").worst, 4.0, 0.01);
    EXPECT_NEAR(finding(judgement, "audience").worst, 2.0, 0.01);
    EXPECT_NEAR(finding(judgement, "altitude_max").worst, 10.0, 0.01);
    EXPECT_FALSE(finding(judgement, "geofence").time_s.has_value());
}

// A plan whose first waypoint was a kilometre outside its own fence was verified.
TEST(JudgeWaypoints, TheirOwnFenceIsJudgedWhereNoOtherIsKnown) {
    RecordedShow show = mission(10.0);
    const geo::ShowFrame frame(*show.origin);
    const auto outline = [&](double from_x, double to_x) {
        GeodeticFence::Outline corners;
        for (const Vec2& p : {Vec2{from_x, -5}, Vec2{to_x, -5}, Vec2{to_x, 5}, Vec2{from_x, 5}})
            corners.push_back(frame.to_geodetic({p.x, p.y, 0.0}));
        return corners;
    };
    show.fence = GeodeticFence{{outline(-5, 104)}, {}};
    EXPECT_NEAR(finding(judged(show), "geofence").worst, 4.0, 0.01);
    EXPECT_TRUE(judged(show).held());
    show.fence = GeodeticFence{{outline(-5, 60)}, {}};
    EXPECT_NEAR(finding(judged(show), "geofence").worst, -40.0, 0.5);
    show.fence = GeodeticFence{{}, {outline(40, 60)}};
    EXPECT_FALSE(finding(judged(show), "audience").held);
    show.origin.reset();  // as in other programs' plans
    EXPECT_FALSE(finding(judged(show), "audience").held);
}

TEST(JudgeWaypoints, BreakRulesBetweenWaypoints) {
    const geo::Airspace cut{.geofence_m = {}, .audience_m = {{{40, -2}, {60, -2}, {50, 4}}}, .obstacles = {}};
    EXPECT_THAT(broken(judged(mission(10.0), airspace(cut))), ElementsAre("audience"));
    EXPECT_THAT(broken(judged(mission(10.0), limits({.ceiling_m = 9.9}))), ElementsAre("altitude_max"));
    EXPECT_TRUE(judged(mission(2.5)).held());
    EXPECT_THAT(broken(judged(mission(2.4))), ElementsAre("altitude_min_navigation"));
    EXPECT_NEAR(finding(judged(mission(2.4)), "altitude_min_navigation").worst, 100.0, 0.1);
}

TEST(JudgeWaypoints, WithoutOriginOrHomeAreHandled) {
    RecordedShow show = mission(10.0);
    show.origin.reset();
    EXPECT_NEAR(finding(judged(show), "altitude_max").worst, 10.0, 0.01);
    show.drones[0].home.reset();
    const auto result = judge(show, {}, aerogram::Run{});
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().message, "drone 1: the file holds no home to count altitudes from");
}

/// A fuzzer's: a leg around the earth took the altitude rule minutes.
TEST(JudgeWaypoints, FarFromHomeAreRefused) {
    RecordedShow show = mission(10.0);
    show.drones[0].waypoints[2].place.latitude_deg = 0.0;
    const auto result = judge(show, {}, aerogram::Run{});
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().message, "drone 1: a waypoint is more than 100 km from home");
}

/// Two drones side by side that wait at the first two of their waypoints.
RecordedShow two_that_wait(double apart_m, const std::vector<double>& first, const std::vector<double>& second) {
    RecordedShow show = mission(10.0);
    const geo::ShowFrame frame(*show.origin);
    RecordedDrone other = show.drones[0];
    other.home = frame.to_geodetic({0, 8, 0});
    other.waypoints[0].place = *other.home;
    other.waypoints[1].place = other.waypoints[2].place = frame.to_geodetic({100, apart_m, 0});
    show.drones.push_back(other);
    show.timing = "absolute";
    for (std::size_t k = 0; k < first.size(); ++k) show.drones[0].waypoints[k].until_s = first[k];
    for (std::size_t k = 0; k < second.size(); ++k) show.drones[1].waypoints[k].until_s = second[k];
    return show;
}

TEST(JudgeWaypoints, ThatWaitForTimesAreJudgedWhereTheyStand) {
    const Judgement near = judged(two_that_wait(1.2, {8.0, 30.0}, {8.0, 30.0}));
    EXPECT_THAT(broken(near), ElementsAre("separation_standing"));
    EXPECT_FALSE(near.separation_claimed);
    const Finding& standing = finding(near, "separation_standing");
    EXPECT_NEAR(standing.worst, 1.2, 1e-3);
    EXPECT_EQ(standing.time_s, 30.0);
    EXPECT_THAT(standing.drones, ElementsAre(1, 2));
    EXPECT_EQ(finding(near, "leaving_times").worst, 0.0);
    const Judgement far = judged(two_that_wait(2.9, {8.0, 30.0}, {8.0, 30.0}));
    EXPECT_TRUE(far.held());
    EXPECT_NEAR(finding(far, "separation_standing").worst, 2.9, 1e-3);
}

/// Against all pairs at all moments, in walls, lines and clouds, downwash in.
TEST(JudgeWaypoints, TheStandingFleetsClosestPairIsThatOfBruteForce) {
    testing::Random random(99);
    for (int n = 0; n < 60; ++n) {
        const Limits limits{.downwash = random.in(1.0, 3.0)};
        const Vec3 box{n % 3 == 0 ? 0.0 : 40.0, n % 3 == 1 ? 0.0 : 60.0, n % 4 == 0 ? 0.0 : 30.0};
        RecordedShow show = mission(10.0);
        const geo::ShowFrame frame(*show.origin);
        const RecordedDrone one = show.drones[0];
        show.drones.clear();
        double least_m = 1e9;
        std::vector<Points> places(3);
        for (std::size_t d = 0; d < 25; ++d) {
            RecordedDrone drone = one;
            drone.waypoints.clear();
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3 p = Vec3{0, 0, 10} + random.in_box({}, box);
                for (const Vec3& q : places[k])
                    least_m = std::min(least_m, glm::length((p - q) / Vec3{1, 1, limits.downwash}));
                places[k].push_back(p);
                drone.waypoints.push_back({frame.to_geodetic(p),
                                           frame.altitude_above({}, p),
                                           1.0,
                                           Waypoint::Kind::fly_to,
                                           10.0 * static_cast<double>(k),
                                           {}});
            }
            show.drones.push_back(drone);
        }
        EXPECT_NEAR(finding(judged(show, testing::limits(limits)), "separation_standing").worst, least_m, 1e-6) << n;
    }
}

TEST(JudgeWaypoints, ThatLeaveAtOtherTimesAreFound) {
    const Judgement apart = judged(two_that_wait(5.0, {8.0, 30.0}, {8.0, 33.0}));
    EXPECT_THAT(broken(apart), ElementsAre("leaving_times"));
    EXPECT_EQ(finding(apart, "leaving_times").worst, 3.0);
    EXPECT_EQ(finding(apart, "leaving_times").time_s, 30.0);
    EXPECT_EQ(finding(judged(two_that_wait(5.0, {8.0, 30.0}, {8.0})), "leaving_times").worst, 86'400.0);
    for (const Finding& each : judged(two_that_wait(0.5, {8.0, 30.0}, {})).findings)
        EXPECT_NE(each.rule, "separation_standing");
}

}  // namespace
}  // namespace aerogram::exporter
