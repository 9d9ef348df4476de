#include "export/waypoint/mission_items.hpp"
#include "export/outgoing/planned_show.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/export/fixed_show.hpp"

namespace aerogram::exporter {
namespace {

using ::testing::ElementsAre;

TEST(MissionItems, GoUpThroughTheKeyframesAndHome) {
    const planner::FlightPlan plan = fixed::show();
    const geo::ShowFrame frame(plan.origin);
    const auto missions = fleet_missions(PlannedShow(plan)).value().drones;
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
    const auto missions = fleet_missions(PlannedShow(plan)).value().drones;
    EXPECT_EQ(missions[0].items[1].hold_s, 1.0);
    EXPECT_EQ(missions[0].items[2].hold_s, 3.0);
}

TEST(MissionItems, WithoutTakeOffActsClimbToTheNavigationAltitude) {
    planner::FlightPlan plan = fixed::show();
    plan.acts.erase(plan.acts.begin());
    plan.acts.pop_back();
    const auto missions = fleet_missions(PlannedShow(plan)).value().drones;
    EXPECT_NEAR(missions[1].items[0].altitude_above_home_m, 2.5, 1e-6);
    EXPECT_NEAR(missions[1].items[3].altitude_above_home_m, 2.5, 1e-6);
}

planner::FlightPlan timed(planner::WaypointTiming timing, UtcSeconds start_utc_s = 1'800'000'000) {
    planner::FlightPlan plan = fixed::show();
    plan.exporting.timing = timing;
    plan.exporting.start_utc_s = start_utc_s;
    return plan;
}

std::vector<int> commands(const std::vector<MissionItem>& items) {
    std::vector<int> found;
    for (const MissionItem& item : items) found.push_back(item.command);
    return found;
}
std::vector<double> parameters(const MissionItem& item) {
    return {item.params.begin(), item.params.begin() + 4};
}

TEST(MissionItems, NeedAGeoidAndRoomOnTheBoard) {
    planner::FlightPlan plan = fixed::show();
    EXPECT_EQ(unsuited_for_missions(PlannedShow(plan)), "");
    plan.keyframes.resize(646, plan.keyframes[0]);
    EXPECT_EQ(unsuited_for_missions(PlannedShow(plan)), "");
    plan.keyframes.resize(647, plan.keyframes[0]);
    EXPECT_EQ(unsuited_for_missions(PlannedShow(plan)),
              "651 mission items a drone, home included; mission_items = 650 (boards hold: 4 KB 161, 8 to 15 KB 303, "
              "16 KB 650, 32 KB 1306)");
    plan.exporting.mission_items = 1306;
    EXPECT_EQ(unsuited_for_missions(PlannedShow(plan)), "");
    plan.exporting.autopilot = planner::Autopilot::px4;  // without the home item
    plan.exporting.mission_items = 650;
    EXPECT_EQ(unsuited_for_missions(PlannedShow(plan)), "");
    plan.origin.geoid_undulation_m.reset();
    EXPECT_EQ(unsuited_for_missions(PlannedShow(plan)),
              "planned homes are above mean sea level: the mission needs geoid_undulation_m");
    EXPECT_FALSE(fleet_missions(PlannedShow(plan)).ok());
}

TEST(MissionItems, OfNoTimingAreThePlacesAlone) {
    const FleetMissions fleet = fleet_missions(PlannedShow(fixed::show())).value();
    EXPECT_THAT(commands(mission_items(fleet, fleet.drones[0])), ElementsAre(22, 16, 16, 16, 21));
}

TEST(MissionItems, OfAbsoluteTimingWaitBehindEveryWaypointButNeverBeforeTakeOff) {
    const planner::FlightPlan plan =
        timed(planner::WaypointTiming::absolute, parse_utc("2026-12-31T23:59:50Z").value());
    EXPECT_EQ(unsuited_for_missions(PlannedShow(plan)), "");
    const FleetMissions fleet = fleet_missions(PlannedShow(plan)).value();
    for (const DroneMission& drone : fleet.drones) {
        const auto items = mission_items(fleet, drone);
        EXPECT_THAT(commands(items), ElementsAre(22, 178, 178, 178, 93, 16, 93, 16, 93, 16, 93, 21));
        EXPECT_EQ(items.size() + 1, item_count(PlannedShow(plan).facts()));
        // The model's speeds over the ground, up and down, so that it does not depend on parameters.
        EXPECT_THAT(parameters(items[1]), ElementsAre(1, 5, -1, 0));
        EXPECT_THAT(parameters(items[2]), ElementsAre(2, 2.5, -1, 0));
        EXPECT_THAT(parameters(items[3]), ElementsAre(3, 2, -1, 0));
        // 8 s, 27 s, 40.6 s and 60.6 s after ten seconds to midnight.
        EXPECT_THAT(parameters(items[4]), ElementsAre(-1, 23, 59, 58));
        EXPECT_THAT(parameters(items[6]), ElementsAre(-1, 0, 0, 17));
        EXPECT_THAT(parameters(items[8]), ElementsAre(-1, 0, 0, 31));
        EXPECT_THAT(parameters(items[10]), ElementsAre(-1, 0, 0, 51));
        for (const std::size_t k : {5u, 7u, 9u}) EXPECT_EQ(items[k].params[0], 1.0);
        for (const MissionItem& item : items)
            EXPECT_EQ(item.frame, item.command == 93 || item.command == 178 ? mav::kMission : mav::kGlobalRelative);
    }
}

TEST(MissionItems, OfSpeedTimingTakeThePlansTimeByTheModel) {
    const FleetMissions fleet = fleet_missions(PlannedShow(timed(planner::WaypointTiming::speed))).value();
    const Points from = fixed::above_pads(), to = fixed::formation_a();
    for (std::size_t i = 0; i < 3; ++i) {
        const auto items = mission_items(fleet, fleet.drones[i]);
        EXPECT_THAT(commands(items), ElementsAre(22, 178, 16, 178, 16, 178, 16, 21));
        EXPECT_EQ(items[1].params[0], 1.0);
        EXPECT_EQ(items[2].params[0], 3.0);  // stands 3 s
        const Vec3 way = to[i] - from[i];
        const double along = items[1].params[1] * glm::length(way) / std::hypot(way.x, way.y);
        EXPECT_NEAR(s_curve_s(fleet.model, along, glm::length(way)), 16.0, 1e-6);
    }
}

TEST(MissionItems, OfSpeedTimingLeaveClimbsAlone) {
    planner::FlightPlan plan = timed(planner::WaypointTiming::speed);
    plan.keyframes[0].formation_m = {fixed::above_pads()[2], fixed::above_pads()[0], fixed::above_pads()[1]};
    const FleetMissions fleet = fleet_missions(PlannedShow(plan)).value();
    EXPECT_THAT(commands(mission_items(fleet, fleet.drones[1])), ElementsAre(22, 16, 178, 16, 178, 16, 21));
}

TEST(MissionItems, Px4CannotWaitForATime) {
    planner::FlightPlan plan = timed(planner::WaypointTiming::absolute);
    plan.exporting.autopilot = planner::Autopilot::px4;
    EXPECT_EQ(unsuited_for_missions(PlannedShow(plan)),
              "timing = absolute: PX4 waits for a number of seconds, not for a time of day; only ArduPilot does");
    plan.exporting.timing = planner::WaypointTiming::speed;
    EXPECT_EQ(unsuited_for_missions(PlannedShow(plan)), "");
    EXPECT_TRUE(fleet_missions(PlannedShow(plan))->px4);
}

}  // namespace
}  // namespace aerogram::exporter
