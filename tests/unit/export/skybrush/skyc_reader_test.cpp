#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "export/skybrush/skyc.hpp"
#include "tests/unit/export/written_files.hpp"

namespace aerogram::exporter {
namespace {

using ::testing::HasSubstr;
using Entries = std::vector<FileBytes>;

Result<RecordedShow> read(const Entries& entries) {
    return read_skyc(std::vector<FileBytes>{{"a.skyc", zip_bytes(entries).value()}});
}
std::string error_of(const Entries& entries) {
    const auto show = read(entries);
    return show ? "none" : show.error().message;
}
/// A show of one drone around these settings.
std::string show_with(const std::string& settings) {
    return R"({"version":1,"swarm":{"drones":[{"type":"generic","settings":{)" + settings + "}}]}}";
}
std::string show_with_points(const std::string& points) {
    return show_with(R"("trajectory":{"version":1,"points":)" + points + "}");
}

constexpr const char* kStand = R"("trajectory":{"version":1,"points":[[0,[1,2,3],[]],[10,[1,2,3],[]]]})";

TEST(SkycReader, ReadsTheSmallestForeignShowWithItsAxes) {
    const auto show = read({{"show.json", show_with(R"("trajectory":{"version":1,"points":[[1.5,[1,2,3]]]})")}});
    ASSERT_TRUE(show.ok()) << show.error().message;
    ASSERT_EQ(show->drones.size(), 1u);
    const RecordedDrone& drone = show->drones[0];
    EXPECT_EQ(drone.name, "drone-001");
    EXPECT_EQ(position_at(drone, 0.0), Vec3(-2.0, 1.0, 3.0));  // Y left is our -x, X front our +y
    EXPECT_FALSE(show->limits || show->origin || show->show_hash || show->certified || drone.home_m);
    EXPECT_TRUE(well_formed(*show).ok());
}

TEST(SkycReader, FollowsReferencesThroughFoldersAndPointers) {
    const auto show = read({{"show.json", R"({"version":1,"swarm":{"$ref":"./parts/swarm.json#/it"}})"},
                            {"parts/swarm.json", R"({"it":{"drones":[{"$ref":"#/one~1two"}]},
                                "one/two":{"settings":{"name":"Ann","trajectory":{"$ref":"../t.json"}}}})"},
                            {"t.json", R"({"version":1,"points":[[0,[0,0,0],[]],[4,[8,0,0],[[4,0,0]]]]})"}});
    ASSERT_TRUE(show.ok()) << show.error().message;
    EXPECT_EQ(show->drones[0].name, "Ann");
    EXPECT_EQ(show->drones[0].pieces[0].degree, 2);
    EXPECT_EQ(position_at(show->drones[0], 2.0), Vec3(0.0, 4.0, 0.0));
}

TEST(SkycReader, LinearPiecesHaveNoAccelerations) {
    const auto linear = read({{"show.json", show_with_points("[[0,[0,0,0],[]],[2,[1,0,0],[]],[5,[1,0,0],[]]]")}});
    ASSERT_TRUE(linear.ok()) << linear.error().message;
    EXPECT_FALSE(linear->rounding.has_acceleration);
    EXPECT_EQ(linear->drones[0].pieces[1].degree, 0);
    const auto curved = read({{"show.json", show_with_points("[[0,[0,0,0],[]],[0.5,[1,0,0],[[0,0,0],[1,0,0]]]]")}});
    ASSERT_TRUE(curved.ok());
    EXPECT_TRUE(curved->rounding.has_acceleration);
    // 24 e / T² and 6 e / T a component, on top of the refit's share.
    EXPECT_NEAR(curved->rounding.acceleration_allowance_mps2, 0.25 * 2.0 + std::sqrt(3.0) * 24.0 * 0.0005 / 0.25,
                1e-12);
    EXPECT_NEAR(curved->rounding.speed_allowance_mps, 0.15 + std::sqrt(3.0) * 6.0 * 0.0005 / 0.5, 1e-12);
}

TEST(SkycReader, TakesLimitsFromValidation) {
    const auto show = read({{"show.json", R"({"version":1,"settings":{"validation":{"maxAltitude":80,"maxVelocityXY":7,
        "maxVelocityZ":1.5,"maxAccelerationXY":3,"maxAccelerationZ":2.5,"minDistance":2.5,"minNavAltitude":4}},
        "swarm":{"drones":[{"settings":{)" + std::string(kStand) +
                                              "}}]}}"}});
    ASSERT_TRUE(show.ok()) << show.error().message;
    ASSERT_TRUE(show->limits);
    EXPECT_EQ(show->limits->ceiling_m, 80.0);
    EXPECT_EQ(show->limits->speed_horizontal_mps, 7.0);
    EXPECT_EQ(show->limits->speed_down_mps, 1.5);
    EXPECT_EQ(show->limits->speed_up_mps, 1.5);
    EXPECT_EQ(show->limits->acceleration_mps2, 2.5);
    EXPECT_EQ(show->limits->min_separation_m, 2.5);
    EXPECT_EQ(show->limits->min_navigation_altitude_m, 4.0);
}

/// What other programs may write differently: all of it shows the same drone.
TEST(SkycReader, ReadsTheSameShowInManyShapes) {
    const std::string lights = R"({"version":1,"data":"BzIGAQA="})";
    const std::string path = R"({"version":1,"points":[[0,[0,0,0],[]],[4,[0,0,8],[[0,0,2],[0,0,6]]],[9,[0,0,8],[]]]})";
    const auto one = [](const std::string& settings) { return R"({"settings":{)" + settings + "}}"; };
    const auto swarm = [](const std::string& drones) { return R"("swarm":{"drones":)" + drones + "}"; };
    const std::string inside = one(R"("name":"Ann","lights":)" + lights + R"(,"trajectory":)" + path);
    const std::vector<Entries> shapes{
        {{"show.json", R"({"version":1,)" + swarm("[" + inside + "]") + "}"}},
        {{"show.json", "\xEF\xBB\xBF{ \"version\" : 1,\n" + swarm("[" + inside + "]") + "}"}},
        {{"show.json",
          R"({"version":1,"extra":[1],"environment":{},"meta":{},"settings":{},)" + swarm("[" + inside + "]") + "}"},
         {"notes.txt", "not json"},
         {"broken.json", "{"},
         {"pictures/", ""}},
        {{"show.json", R"({"$ref":"real.json#/a"})"},
         {"real.json", R"({"a":{"version":1,)" + swarm("[" + inside + "]") + "}}"}},
        {{"show.json", R"({"version":1,)" + swarm(R"({"$ref":"./d.json#/x/0"})") + "}"},
         {"d.json", R"({"x":[[{"$ref":"#/y"}]],"y":)" + inside + "}"}},
        {{"show.json", R"({"version":1,)" +
                           swarm("[" +
                                 one(R"("name":"Ann","lights":{"$ref":"./the%20drone/l.json"},"trajectory":)"
                                     R"({"$ref":"./the%20drone/t.json#"})") +
                                 "]") +
                           "}"},
         {"the drone/t.json", path},
         {"the drone/l.json", R"({"version":1,"data":{"$ref":"data.json"}})"},
         {"the drone/data.json", R"("BzIGAQA=")"}},
        {{"show.json", R"({"version":1,)" +
                           swarm("[" +
                                 one(R"("name":"Ann","lights":)" + lights +
                                     R"(,"trajectory":)"
                                     R"({"points":[[0,[0,0,0]],[4,[0,0,8],[[0,0,2],[0,0,6]]],[9,[0,0,8],null]]})") +
                                 "]") +
                           "}"}},
        {{"show.json", R"({"version":1,)" +
                           swarm("[" +
                                 one(R"("name":"Ann","lights":)" + lights +
                                     R"(,"trajectory":{"version":1,)"
                                     R"("takeoffTime":0,"landingTime":9,"points":[[0.0,[0,-0,0.0],[]],)"
                                     R"([4e0,[0,0,8.00],[[0,0,2],[0,0,6]]],[9,[0,0,8],[]]]})") +
                                 "]") +
                           "}"}},
    };
    const RecordedShow expected = read(shapes.front()).value();
    EXPECT_NEAR(position_at(expected.drones[0], 2.0).z, 4.0, 1e-12);
    for (std::size_t k = 0; k < shapes.size(); ++k) {
        const auto show = read(shapes[k]);
        ASSERT_TRUE(show.ok()) << k << ": " << show.error().message;
        ASSERT_EQ(show->drones.size(), 1U) << k;
        EXPECT_EQ(show->drones[0].name, "Ann") << k;
        EXPECT_EQ(show->drones[0].controls_m, expected.drones[0].controls_m) << k;
        EXPECT_EQ(show->drones[0].tracks.lights, expected.drones[0].tracks.lights) << k;
        EXPECT_EQ(show->duration_s, 9.0) << k;
    }
}

/// Points of a trajectory count from its take-off.
TEST(SkycReader, TakeoffTimeShiftsTheTrajectory) {
    const auto show = read({{"show.json", show_with(R"("trajectory":{"version":1,"takeoffTime":5.5,
        "points":[[0,[0,0,0],[]],[4,[0,0,8],[]]]})")}});
    ASSERT_TRUE(show.ok()) << show.error().message;
    EXPECT_EQ(position_at(show->drones[0], 5.5).z, 0.0);
    EXPECT_EQ(position_at(show->drones[0], 7.5).z, 4.0);
    EXPECT_EQ(show->duration_s, 9.5);
    EXPECT_THAT(error_of({{"show.json", show_with(R"("trajectory":{"version":1,"takeoffTime":-5,
        "points":[[0,[0,0,0],[]],[4,[0,0,8],[]]]})")}}),
                HasSubstr("points[0][0]: must be in the show's first 86400 s"));
}

/// Many drones may share one file, or one trajectory; each other file is let go when its drone was read.
TEST(SkycReader, DronesMayShareFiles) {
    std::string drones;
    for (int k = 0; k < 50; ++k)
        drones += std::string(k == 0 ? "" : ",") +
                  R"({"settings":{"home":{"$ref":"all.json#/home"},"trajectory":{"$ref":)" +
                  (k % 2 == 0 ? R"("all.json#/paths/)" + std::to_string(k) : R"("own.json#/)") + R"("}}})";
    std::string paths;
    for (int k = 0; k < 50; ++k)
        paths += (k == 0 ? "" : ",") + (R"({"points":[[0,[0,0,0],[]],[4,[0,0,)" + std::to_string(k + 1) + "],[]]]}");
    const auto show = read({{"show.json", R"({"version":1,"swarm":{"drones":[)" + drones + "]}}"},
                            {"all.json", R"({"home":[1,2,3],"paths":[)" + paths + "]}"},
                            {"own.json", R"({"":{"points":[[0,[0,0,0],[]],[4,[0,0,100],[]]]}})"}});
    ASSERT_TRUE(show.ok()) << show.error().message;
    for (int k = 0; k < 50; ++k) {
        const RecordedDrone& drone = show->drones[static_cast<std::size_t>(k)];
        EXPECT_EQ(drone.home_m, Vec3(-2.0, 1.0, 3.0));
        EXPECT_EQ(last_position(drone).z, k % 2 == 0 ? k + 1.0 : 100.0);
    }
}

TEST(SkycReader, TakesTheGeofence) {
    const auto fence = [](const std::string& polygons) {
        return Entries{{"show.json", R"({"version":1,"settings":{"geofence":{"version":1,"polygons":)" + polygons +
                                         R"(}},"swarm":{"drones":[{"settings":{)" + kStand + "}}]}}"}};
    };
    const auto show = read(fence(R"([{"isInclusion":true,"points":[[0,0,0],[50,0,0],[50,40],[0,0,0]]},
        {"isInclusion":false,"points":[[5,5],[6,5],[6,6]]}])"));
    ASSERT_TRUE(show.ok()) << show.error().message;
    ASSERT_TRUE(show->airspace);
    EXPECT_EQ(show->airspace->geofence_m, (geo::Polygon{{0, 0}, {0, 50}, {-40, 50}}));
    EXPECT_EQ(show->airspace->audience_m.size(), 1U);
    EXPECT_THAT(error_of(fence(R"([{"isInclusion":true,"points":[[0,0],[1,1]]}])")), HasSubstr("polygons[0].points"));
}

TEST(SkycReader, MusicMustBeInTheArchive) {
    const auto with = [](const char* data) {
        return R"({"version":1,"media":{"audio":{"mediaType":"audio/mpeg","startTime":0,"data":)" + std::string(data) +
               R"(}},"swarm":{"drones":[{"settings":{)" + kStand + "}}]}}";
    };
    EXPECT_EQ(error_of({{"show.json", with(R"({"$ref":"./a%20b.mp3#"})")}, {"a b.mp3", "ID3"}}), "none");
    EXPECT_EQ(error_of({{"show.json", with("\"SUQz\"")}}), "none");
    EXPECT_EQ(error_of({{"show.json", with(R"({"$ref":"./a.mp3"})")}}),
              "a.skyc: show.json: media.audio.data: $ref: no such entry");
}

TEST(SkycReader, LocationsMayLackAHeightAndAutomaticYawHasNoKeys) {
    const auto show = read({{"show.json", R"({"version":1,"environment":{"location":{"origin":[524734000.0,134017000],
        "orientation":30}},"swarm":{"drones":[{"settings":{"yawControl":{"version":1,"autoYaw":true,"setpoints":[[0,1]]},)" +
                                              std::string(kStand) + "}}]}}"}});
    ASSERT_TRUE(show.ok()) << show.error().message;
    EXPECT_FALSE(show->origin);
    EXPECT_TRUE(show->drones[0].tracks.yaw.empty());
}

TEST(SkycReader, ErrorsNameEntryAndKey) {
    const auto points = [](const char* list) { return error_of({{"show.json", show_with_points(list)}}); };
    const std::string at = "a.skyc: show.json: swarm.drones[0].settings.";
    EXPECT_EQ(points("[]"), at + "trajectory.points: needs at least one point");
    EXPECT_EQ(points("[[0,[0,0,0],[]],[0,[0,0,0],[]]]"),
              at + "trajectory.points[1][0]: must be later than the point before");
    EXPECT_EQ(points("[[0,[0,0],[]]]"), at + "trajectory.points[0][1]: must be [x, y, z]");
    EXPECT_EQ(points("[[0,[0,0,\"1\"],[]]]"), at + "trajectory.points[0][1][2]: must be a number from -1e+06 to 1e+06");
    EXPECT_THAT(points("[[0,[0,0,1e300],[]]]"), HasSubstr("must be a number from"));
    EXPECT_EQ(points("[[0,[0,0,0],[]],[1,[0,0,0],[[0,0,0],[0,0,0],[0,0,0]]]]"),
              at + "trajectory.points[1][2]: must be at most two control points");
    EXPECT_EQ(points("7"), at + "trajectory.points: must be an array");
    EXPECT_EQ(points("[[-1,[0,0,0],[]]]"), at + "trajectory.points[0][0]: must be in the show's first 86400 s");
    EXPECT_EQ(error_of({{"show.json", show_with("\"name\":\"x\"")}}), at + "trajectory: is missing");
    EXPECT_EQ(error_of({{"show.json", show_with("\"name\":5")}}), at + "name: must be a text");
    EXPECT_EQ(error_of({{"show.json", R"({"version":2})"}}),
              "a.skyc: show.json: version: must be a whole number from 1 to 1");
    EXPECT_EQ(error_of({{"show.json", R"({"version":1,"swarm":{"drones":[]}})"}}),
              "a.skyc: show.json: swarm.drones: needs at least one drone");
    EXPECT_EQ(error_of({{"show.json", "{\"version\":1,}"}}), "a.skyc: show.json: byte 14: is not JSON");
    EXPECT_EQ(error_of({{"show.json", "[1e999]"}}), "a.skyc: show.json: holds a number out of range");
    EXPECT_EQ(error_of({{"other.json", "{}"}}), "a.skyc: holds no show.json");
}

TEST(SkycReader, LightErrorsNameTheProgramsByte) {
    const std::string lights = std::string(kStand) + R"(,"lights":{"version":1,"data":)";
    EXPECT_THAT(error_of({{"show.json", show_with(lights + "\"!!\"}")}}), HasSubstr("lights.data: is not base64"));
    EXPECT_THAT(error_of({{"show.json", show_with(lights + "\"EwA=\"}")}}),
                HasSubstr("lights.data: light program, byte 0: instruction 19 is not known"));
}

TEST(SkycReader, RefusesReferencesThatLeadNowhereOrInCircles) {
    EXPECT_THAT(error_of({{"show.json", R"({"$ref":"#"})"}}), HasSubstr("more than 16 references"));
    EXPECT_THAT(error_of({{"show.json", R"({"$ref":"./b.json#"})"}, {"b.json", R"({"$ref":"./show.json#"})"}}),
                HasSubstr("more than 16 references"));
    EXPECT_EQ(error_of({{"show.json", R"({"version":1,"swarm":{"$ref":"./nope.json#"}})"}}),
              "a.skyc: show.json: swarm: $ref \"./nope.json#\": no such entry");
    EXPECT_THAT(error_of({{"show.json", R"({"version":1,"swarm":{"$ref":"../../etc.json#"}})"}}),
                HasSubstr("no such entry"));
    EXPECT_EQ(error_of({{"show.json", R"({"version":1,"swarm":{"$ref":"#/a/b"}})"}}),
              "a.skyc: show.json: nothing at \"/a/b\"");
    EXPECT_THAT(error_of({{"show.json", R"({"version":1,"swarm":{"$ref":"#a~9"}})"}}), HasSubstr("nothing at"));
}

TEST(SkycReader, DeeplyNestedJsonIsRefusedNotCrashedOn) {
    EXPECT_NE(error_of({{"show.json", std::string(2'000'000, '[')}}), "none");
    EXPECT_NE(error_of({{"show.json", std::string(1'000'000, '[') + std::string(1'000'000, ']')}}), "none");
}

TEST(SkycReader, DamagedArchivesAreRefusedNotCrashedOn) {
    const std::string bytes = zip_bytes(std::vector<FileBytes>{{"show.json", show_with(kStand)}}).value();
    std::size_t refused = 0;
    for_damaged(bytes, 2'000, [&](const std::string& damaged) {
        refused += read_skyc(std::vector<FileBytes>{{"a.skyc", damaged}}).ok() ? 0u : 1u;
    });
    EXPECT_GT(refused, 1'000u);
}

TEST(SkycReader, DamagedJsonIsRefusedNotCrashedOn) {
    const std::string json = show_with(std::string(kStand) + R"(,"name":"x","home":[1,2,3],
        "yawControl":{"version":1,"setpoints":[[1,90]]},"pyro":{"version":1,"events":[[1,2,"k"]]})");
    std::size_t read_well = 0;
    for_damaged(json, 2'000, [&](const std::string& damaged) {
        const auto show = read({{"show.json", damaged}});
        if (show) {
            EXPECT_TRUE(well_formed(*show).ok()) << damaged;
        }
        read_well += show ? 1u : 0u;
    });
    EXPECT_GT(read_well, 0u);
}

}  // namespace
}  // namespace aerogram::exporter
