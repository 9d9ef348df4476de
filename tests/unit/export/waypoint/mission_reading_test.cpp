#include "export/waypoint/mission_reading.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace aerogram::exporter {
namespace {

using ::testing::HasSubstr;

constexpr geo::Geodetic kHome{35.0, 139.0, 0.0};

MissionReading ready() {
    return {kHome, 40.0};
}
RecordedDrone read(const std::vector<MissionItem>& items) {
    MissionReading reading = ready();
    for (const MissionItem& item : items) EXPECT_TRUE(reading.take(item).ok());
    return reading.drone();
}
MissionItem wait_until(double hour, double minute, double second) {
    return {2, 93, {-1.0, hour, minute, second, 0.0, 0.0, 0.0}};
}
const MissionItem kUp{3, 22, {0, 0, 0, 0, 0, 0, 10.0}}, kThere{3, 16, {2, 0, 0, 0, 35.1, 139.1, 20.0}};

TEST(MissionReading, OfOtherProgramsIsUnderstood) {
    const RecordedDrone drone =
        read({kUp, {0, 16, {2, 0, 0, 0, 35.1, 139.1, 60.0}}, {3, 82, {0, 0, 0, 0, 35.2, 139.2, 20.0}}, {3, 20, {}}});
    ASSERT_EQ(drone.waypoints.size(), 4u);
    EXPECT_EQ(drone.waypoints[0].place.latitude_deg, 35.0);
    EXPECT_EQ(drone.waypoints[0].kind, Waypoint::Kind::takeoff);
    EXPECT_EQ(drone.waypoints[1].altitude_above_home_m, 20.0);
    EXPECT_EQ(drone.waypoints[1].hold_s, 2.0);
    EXPECT_EQ(drone.waypoints[3].kind, Waypoint::Kind::land);
    EXPECT_EQ(drone.waypoints[3].place.longitude_deg, 139.0);
    EXPECT_TRUE(read({{2, 112, {}}, {2, 183, {}}, {2, 206, {}}}).waypoints.empty());
}

TEST(MissionReading, RefusesWhatItCannotTell) {
    const auto error = [&](const MissionItem& item) { return ready().take(item).error().message; };
    EXPECT_THAT(error({3, 84, {}}), HasSubstr("command 84: only take-off"));
    EXPECT_THAT(error({10, 16, {}}), HasSubstr("frame 10: must be 0 or 5 (AMSL), 3 or 6 (above home)"));
    EXPECT_THAT(error({3, 16, {0, 0, 0, 0, 91, 0, 5}}), HasSubstr("within 90 and 180"));
    EXPECT_THAT(error({3, 16, {0, 0, 0, 0, 9, 9, 1e6}}), HasSubstr("within 100 km"));
    EXPECT_THAT(error({3, 16, {-1, 0, 0, 0, 9, 9, 5}}), HasSubstr("hold must be"));
}

TEST(MissionReading, WithoutAHomeItIsTheFirstTakeOffsPlace) {
    MissionReading reading({}, {});
    EXPECT_THAT(reading.take(kThere).error().message, HasSubstr("must begin with a take-off that has a place"));
    EXPECT_TRUE(reading.take({3, 22, {0, 0, 0, 0, 35.5, 139.5, 10.0}}).ok());
    EXPECT_TRUE(reading.take(kThere).ok());
    EXPECT_THAT(reading.take({0, 16, {0, 0, 0, 0, 35.1, 139.1, 60.0}}).error().message,
                HasSubstr("frame 0: this file holds no home to measure AMSL from"));
    const RecordedDrone drone = reading.drone();
    EXPECT_EQ(drone.home->latitude_deg, 35.5);
    EXPECT_FALSE(drone.home_amsl_m.has_value());
    EXPECT_EQ(drone.waypoints.size(), 2u);
}

TEST(MissionReading, WaitsAndSpeedsBelongToTheirWaypoints) {
    const RecordedDrone drone = read({wait_until(9, 0, 0),
                                      kUp,
                                      wait_until(10, 0, 8),
                                      {2, 178, {1, 3.5, -1, 0, 0, 0, 0}},
                                      {2, 178, {2, 9.0, -1, 0, 0, 0, 0}},
                                      kThere,
                                      {2, 93, {4, 0, 0, 0, 0, 0, 0}},
                                      kThere});
    EXPECT_EQ(drone.waypoints[0].until_s, 36'008.0);  // the wait on the ground moves nobody
    EXPECT_FALSE(drone.waypoints[0].speed_mps.has_value());
    EXPECT_EQ(drone.waypoints[1].speed_mps, 3.5);  // climb rates are no speeds over the ground
    EXPECT_EQ(drone.waypoints[1].hold_s, 6.0);
    EXPECT_FALSE(drone.waypoints[1].until_s || drone.waypoints[2].speed_mps);
    for (const MissionItem& vague :
         {wait_until(-1, 5, 0), wait_until(24, 0, 0), wait_until(1, 60, 0), wait_until(1, 1, 1.5)})
        EXPECT_FALSE(read({kUp, vague}).waypoints[0].until_s.has_value());
}

TEST(MissionReading, TimesGoThroughMidnight) {
    RecordedShow show;
    show.drones = {read({kUp, wait_until(23, 59, 50), kThere, wait_until(0, 0, 20), kThere, wait_until(0, 0, 20)}),
                   read({kUp, wait_until(23, 59, 49), kThere, wait_until(0, 0, 20)})};
    RecordedShow relative = show;
    settle_times(show, parse_utc("2026-12-31T23:59:40Z"));
    EXPECT_EQ(show.timing, "absolute");
    EXPECT_EQ(show.drones[0].waypoints[0].until_s, 10.0);
    EXPECT_EQ(show.drones[0].waypoints[1].until_s, 40.0);
    EXPECT_EQ(show.drones[0].waypoints[2].until_s, 40.0);
    EXPECT_EQ(show.drones[1].waypoints[0].until_s, 9.0);
    settle_times(relative, {});
    EXPECT_EQ(relative.drones[0].waypoints[0].until_s, 0.0);
    EXPECT_EQ(relative.drones[1].waypoints[0].until_s, -1.0);
    EXPECT_EQ(relative.drones[1].waypoints[1].until_s, 30.0);
}

TEST(MissionReading, TimingIsWhatAllDronesDo) {
    RecordedShow show;
    const MissionItem speed{2, 178, {1, 3.5, -1, 0, 0, 0, 0}};
    show.drones = {read({kUp, speed, kThere}), read({kUp, kThere})};
    settle_times(show, {});
    EXPECT_EQ(show.timing, "speed: legs 0.5 to 5 s late, vehicles up to 4 s apart");
    show = {};
    show.drones = {read({kUp, kThere}), read({kUp, wait_until(1, 2, 3)})};
    settle_times(show, {});
    EXPECT_EQ(show.timing, "");
}

}  // namespace
}  // namespace aerogram::exporter
