#include "export/waypoint/mission_items.hpp"
#include "export/outgoing/planned_show.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/export/fixed_show.hpp"

namespace aerogram::exporter {
namespace {

using ::testing::HasSubstr;

TEST(MissionItems, GoUpThroughTheKeyframesAndHome) {
    const planner::FlightPlan plan = fixed::show();
    const geo::ShowFrame frame(plan.origin);
    const auto missions = drone_missions(PlannedShow(plan)).value();
    ASSERT_EQ(missions.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        const DroneMission& mission = missions[i];
        EXPECT_EQ(mission.name, "drone-00" + std::to_string(i + 1));
        const Points places{fixed::above_pads()[i], fixed::formation_a()[i], fixed::formation_b()[i],
                            fixed::above_pads()[i], fixed::pads()[i]};
        ASSERT_EQ(mission.items.size(), places.size());
        for (std::size_t k = 0; k < places.size(); ++k) {
            EXPECT_LT(glm::length(frame.to_show(mission.items[k].place) - places[k]), 1e-6) << i << " item " << k;
            EXPECT_NEAR(mission.items[k].altitude_above_home_m, frame.altitude_above(plan.pads_m[i], places[k]), 1e-9);
        }
        EXPECT_EQ(mission.items.front().kind, Waypoint::Kind::takeoff);
        EXPECT_EQ(mission.items.back().kind, Waypoint::Kind::land);
        EXPECT_EQ(mission.items[1].hold_s, 3.0);
        EXPECT_EQ(mission.items[2].hold_s, 4.0);
        EXPECT_LT(glm::length(frame.to_show(mission.home) - plan.pads_m[i]), 1e-6);
    }
    EXPECT_NEAR(missions[2].home_amsl_m, 40.0 - 36.7 + 0.125, 1e-3);
}

/// Autopilots meet only waypoints they stop at.
TEST(MissionItems, StopASecondWhereAFlowPasses) {
    planner::FlightPlan plan = fixed::show();
    plan.keyframes[0].stands_to_ms = plan.keyframes[0].stands_from_ms;
    plan.keyframes[1].stands_to_ms = plan.keyframes[1].stands_from_ms + 2'600;
    const auto missions = drone_missions(PlannedShow(plan)).value();
    EXPECT_EQ(missions[0].items[1].hold_s, 1.0);
    EXPECT_EQ(missions[0].items[2].hold_s, 3.0);
}

TEST(MissionItems, WithoutTakeOffActsClimbToTheNavigationAltitude) {
    planner::FlightPlan plan = fixed::show();
    plan.acts.erase(plan.acts.begin());
    plan.acts.pop_back();
    const auto missions = drone_missions(PlannedShow(plan)).value();
    EXPECT_NEAR(missions[1].items[0].altitude_above_home_m, 2.5, 1e-6);
    EXPECT_NEAR(missions[1].items[3].altitude_above_home_m, 2.5, 1e-6);
}

TEST(MissionItems, NeedAGeoidAndRoomOnTheBoard) {
    planner::FlightPlan plan = fixed::show();
    EXPECT_EQ(unsuited_for_missions(PlannedShow(plan)), "");
    plan.keyframes.resize(1'303);
    EXPECT_EQ(unsuited_for_missions(PlannedShow(plan)), "1307 mission items a drone; at most 1306 fit");
    plan.origin.geoid_undulation_m.reset();
    EXPECT_EQ(unsuited_for_missions(PlannedShow(plan)),
              "planned homes are above mean sea level: the mission needs geoid_undulation_m");
    EXPECT_FALSE(drone_missions(PlannedShow(plan)).ok());
}

TEST(MissionItems, OfOtherProgramsAreUnderstoodOrRefused) {
    const geo::Geodetic home{35.0, 139.0, 0.0};
    const auto amsl = waypoint_of({0, 16, {2, 0, 0, 0, 35.1, 139.1, 60.0}}, home, 40.0);
    ASSERT_TRUE(amsl.ok());
    EXPECT_EQ((*amsl)->altitude_above_home_m, 20.0);
    EXPECT_EQ((*amsl)->hold_s, 2.0);
    const auto takeoff = waypoint_of({3, 22, {0, 0, 0, 0, 0, 0, 10.0}}, home, 40.0);
    EXPECT_EQ((*takeoff)->place.latitude_deg, 35.0);
    EXPECT_EQ((*takeoff)->kind, Waypoint::Kind::takeoff);
    const auto returns = waypoint_of({3, 20, {}}, home, 40.0);
    EXPECT_EQ((*returns)->kind, Waypoint::Kind::land);
    for (const int command : {93, 112, 178, 183, 206})
        EXPECT_FALSE(waypoint_of({2, command, {}}, home, 40.0)->has_value());
    const auto error = [&](const MissionItem& item) { return waypoint_of(item, home, 40.0).error().message; };
    EXPECT_THAT(error({3, 84, {}}), HasSubstr("command 84: only take-off"));
    EXPECT_THAT(error({10, 16, {}}), HasSubstr("frame 10: must be 0 or 5 (AMSL), 3 or 6 (above home)"));
    EXPECT_THAT(error({3, 16, {0, 0, 0, 0, 91, 0, 5}}), HasSubstr("within 90 and 180"));
    EXPECT_THAT(error({3, 16, {0, 0, 0, 0, 9, 9, 1e6}}), HasSubstr("within 100 km"));
    EXPECT_THAT(error({3, 16, {-1, 0, 0, 0, 9, 9, 5}}), HasSubstr("hold must be"));
}

}  // namespace
}  // namespace aerogram::exporter
