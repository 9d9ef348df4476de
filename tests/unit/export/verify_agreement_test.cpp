#include "export/verify_agreement.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

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

// The light programs of two drones of a .skyc had been swapped, and the folder was verified.
TEST(DisagreementOfLights, IsSaidWhereALampIsSteady) {
    RecordedShow reference = line_show(0.0);
    reference.format = "trajectories";
    reference.drones[0].tracks.lights = {{0, {1.0, 0.0, 0.0}, false}, {5'000, {0.0, 0.0, 1.0}, false}};
    RecordedShow show = reference;
    show.format = "skyc";
    EXPECT_THAT(disagreement_of_lights(reference, show), IsEmpty());
    show.drones[0].tracks.lights[0].time_ms = 20;  // a tick late is no other light
    EXPECT_THAT(disagreement_of_lights(reference, show), IsEmpty());
    show.drones[0].tracks.lights[1].color = {0.0, 1.0, 0.0};
    EXPECT_THAT(disagreement_of_lights(reference, show),
                ElementsAre(StartsWith("drone 1 at 5.12 s has another light than trajectories")));
    show.format = "kmz";  // keeps no lights
    EXPECT_THAT(disagreement_of_lights(reference, show), IsEmpty());
}

TEST(DisagreementOfSeparations, IsBeyondTheSumOfTheRoundings) {
    RecordedShow two = line_show(0.0);
    two.drones.push_back(two.drones[0]);
    EXPECT_THAT(disagreement_of_separations(two, 1.6, two, 1.41, Limits{}), IsEmpty());
    EXPECT_THAT(disagreement_of_separations(two, 1.6, two, 1.39, Limits{}),
                ElementsAre(StartsWith("the smallest separation is 1.39 m, in lines 1.6 m")));
}

Manifest manifest_with_fence() {
    Manifest manifest;
    manifest.show_hash = std::string(32, 'a') + std::string(32, '7');
    manifest.origin = {{35.0, 139.0, 40.0}, 20.0, {}};
    manifest.airspace.geofence_m = {{-50, -50}, {50, -50}, {50, 50}, {-50, 50}};
    manifest.drones = {{"drone-001", {1.0, -20.0, 0.0}}, {"drone-002", {3.5, -20.0, 0.0}}};
    manifest.fleet = 2;
    return manifest;
}

// A fence turned by seven degrees let a fleet fly where nobody expected it (FORMATS.md, accidents).
TEST(DisagreementWithManifest, AFenceElsewhereIsSaid) {
    const Manifest manifest = manifest_with_fence();
    const geo::ShowFrame frame(manifest.origin);
    geo::ShowOrigin turned = manifest.origin;
    turned.heading_deg += 7.0;
    for (const bool wrong : {false, true}) {
        RecordedShow show;
        show.format = "qgc";
        show.fence.emplace().inside.emplace_back();
        for (const Vec2& p : manifest.airspace.geofence_m)
            show.fence->inside[0].push_back((wrong ? geo::ShowFrame(turned) : frame).to_geodetic({p.x, p.y, 0.0}));
        const Problems problems = disagreement_with_manifest(show, manifest);
        EXPECT_EQ(std::ranges::find(problems, "the fence differs from the manifest") != problems.end(), wrong);
    }
}

TEST(DisagreementOfPaper, PadsAndPagesOfAnotherShowAreSaid) {
    const Manifest manifest = manifest_with_fence();
    const std::string header = "pad,drone,name,link,system_id,x_m,y_m,z_m\n";
    const std::string first = "1,1,drone-001,1,1,1.000,-20.000,0.000\n",
                      second = "2,2,drone-002,1,2,3.500,-20.000,0.000\n";
    EXPECT_THAT(disagreement_of_paper({"pads.csv", header + first + second}, manifest), IsEmpty());
    EXPECT_THAT(disagreement_of_paper({"pads.csv", header + first}, manifest), ElementsAre("1 rows for 2 drones"));
    EXPECT_THAT(
        disagreement_of_paper({"pads.csv", header + "1,1,drone-001,1,1,3.500,-20.000,0.000\n" + second}, manifest),
        ElementsAre("drone-001 stands elsewhere than in the manifest"));
    EXPECT_THAT(disagreement_of_paper({"report.html", "aaaa aaaa aaaa aaaa aaaa aaaa aaaa aaaa"}, manifest), IsEmpty());
    EXPECT_EQ(disagreement_of_paper({"report.html", "bbbb"}, manifest).size(), 1U);
}

}  // namespace
}  // namespace aerogram::exporter
