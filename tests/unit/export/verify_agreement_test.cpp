#include "export/verify_agreement.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace aerogram::exporter {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::StartsWith;

/// One drone, 10 m along x in 10 s, 5 cm of rounding.
RecordedShow line_show(double shift_m) {
    RecordedShow show;
    show.format = "lines";
    show.duration_s = 10.0;
    show.rounding.fit_m = 0.05;
    RecordedDrone drone;
    drone.controls_m = {{shift_m, 0, 10}, {10 + shift_m, 0, 10}};
    drone.pieces = {{0.0, 10.0, 0, 1}};
    show.drones = {drone};
    return show;
}

TEST(DisagreementOfShows, IsBeyondTheSumOfTheRoundings) {
    const geo::ShowOrigin origin{{35.0, 139.0, 40.0}, 20.0, {}};
    EXPECT_THAT(disagreement_of_shows(line_show(0.0), line_show(0.0999), Limits{}, origin), IsEmpty());
    EXPECT_THAT(disagreement_of_shows(line_show(0.0), line_show(0.11), Limits{}, origin),
                ElementsAre(StartsWith("drone 1 at 0 s is 0.11 m from where lines has it (0.1 m may differ)")));
}

TEST(DisagreementOfShows, WaypointsLieOnTheTrajectory) {
    const geo::ShowOrigin origin{{35.0, 139.0, 40.0}, 20.0, {}};
    const geo::ShowFrame frame(origin);
    RecordedShow reference = line_show(0.0), mission;
    reference.drones[0].home_m = Vec3{0, 0, 0};
    mission.timed = false;
    RecordedDrone drone;
    drone.home = frame.to_geodetic({0, 0, 0});
    drone.home->height_m = 0.0;  // unknown to the format
    drone.waypoints = {{frame.to_geodetic({10, 0, 10}), 10.0, 1.0, Waypoint::Kind::fly_to}};
    mission.drones = {drone};
    EXPECT_THAT(disagreement_of_shows(reference, mission, Limits{}, origin), IsEmpty());
    mission.drones[0].waypoints[0].altitude_above_home_m = 10.2;
    EXPECT_THAT(disagreement_of_shows(reference, mission, Limits{}, origin),
                ElementsAre(StartsWith("drone 1: waypoint 1 is 0.2 m from where lines goes")));
}

}  // namespace
}  // namespace aerogram::exporter
