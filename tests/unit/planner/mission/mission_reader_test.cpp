#include "planner/mission/mission_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "geo/units.hpp"
#include "mission_text.hpp"

namespace aerogram::planner::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(MissionReader, FillsInEveryDefault) {
    const auto m = parse_with("");
    ASSERT_TRUE(m.ok()) << message(m);
    EXPECT_EQ(m->file, "m.toml");
    EXPECT_EQ(m->name, "test");
    EXPECT_EQ(m->seed, 1U);
    EXPECT_EQ(m->origin.heading_deg, 0.0);
    EXPECT_FALSE(m->origin.geoid_undulation_m.has_value());
    EXPECT_FALSE(m->audio.has_value());
    EXPECT_EQ(m->fleet.drones, 4U);
    EXPECT_EQ(m->fleet.endurance_s, 900.0);
    EXPECT_EQ(m->light_rate_hz, 25.0);
    EXPECT_TRUE(m->airspace.geofence_m.empty());
    EXPECT_TRUE(m->airspace.obstacles.empty());
    ASSERT_EQ(m->keyframes.size(), 1U);
    const Keyframe& k = m->keyframes[0];
    EXPECT_EQ(k.hold_s, 3.0);
    EXPECT_FALSE(k.at_s.has_value());
    EXPECT_EQ(k.center_m, Vec3{});
    ASSERT_EQ(k.parts.size(), 1U);
    EXPECT_EQ(k.parts[0].center_m, Vec3(0, 0, 20));
    EXPECT_EQ(k.parts[0].drones, 4U);
    EXPECT_FALSE(k.parts[0].color.has_value());
    EXPECT_FALSE(k.parts[0].size.width_m.has_value());
    EXPECT_EQ(k.arrive.method, Method::straight);
    EXPECT_EQ(k.arrive.assign, Assign::shortest);
    EXPECT_EQ(k.arrive.profile, ProfileKind::minimum_jerk);
    EXPECT_EQ(k.arrive.separation, SeparationMethod::projection);
    EXPECT_EQ(k.arrive.spectral.align, Align::kabsch);
    EXPECT_EQ(k.arrive.spectral.reorder, Reorder::optimal);
    EXPECT_FALSE(k.arrive.spectral.inflate);
    EXPECT_EQ(k.arrive.flow.tension, 0.5);
    EXPECT_EQ(k.arrive.flow.of, FlowOf::positions);
}

TEST(MissionReader, KeepsLinesForLaterMessages) {
    const auto m = parse_with("[keyframe.arrive]\nmethod = \"spectral\"\n");
    ASSERT_TRUE(m.ok()) << message(m);
    EXPECT_EQ(m->fleet.line, 4);
    EXPECT_EQ(m->keyframes[0].line, 7);
    EXPECT_EQ(m->keyframes[0].parts[0].line, 7);
    EXPECT_EQ(m->keyframes[0].arrive.line, 11);
    EXPECT_EQ(m->at(7, "keyframe[1].size_m = 3: needs >= 7.5"), "m.toml:7: keyframe[1].size_m = 3: needs >= 7.5");
    EXPECT_EQ(keyframe_key(*m, 0), "keyframe[1]");
}

TEST(MissionReader, AmslHeightBecomesEllipsoidal) {
    const auto m = parse(
        "[show]\nname = \"x\"\ngeoid_undulation_m = 36.7\n"
        "origin = { latitude_deg = 35, longitude_deg = 139, height_m = 3.3, datum = \"amsl\", heading_deg = -20 }\n" +
        kFleet + kKeyframe);
    ASSERT_TRUE(m.ok()) << message(m);
    EXPECT_DOUBLE_EQ(m->origin.ground.height_m, 40.0);
    EXPECT_EQ(m->origin.geoid_undulation_m, 36.7);
    EXPECT_EQ(m->origin.heading_deg, -20.0);
}

TEST(MissionReader, GeofenceIsInTheShowFrame) {
    // At heading 90 show +y is east and +x is south: the northern corners have negative x.
    const auto m = parse(
        "[show]\nname = \"x\"\n"
        "origin = { latitude_deg = 46.2, longitude_deg = 6.1, height_m = 400, heading_deg = 90 }\n" +
        kFleet + kKeyframe +
        "[airspace]\ngeofence = [[46.199, 6.099], [46.199, 6.101], [46.201, 6.101], [46.201, 6.099]]\n"
        "audience = [[[46.1995, 6.0995], [46.1995, 6.0996], [46.1996, 6.0996]]]\n");
    ASSERT_TRUE(m.ok()) << message(m);
    ASSERT_EQ(m->airspace.geofence_m.size(), 4U);
    EXPECT_NEAR(m->airspace.geofence_m[0].x, 111.2, 0.3);  // 0.001 degrees of latitude
    EXPECT_NEAR(m->airspace.geofence_m[0].y, -77.2, 0.3);  // 0.001 degrees of longitude at 46.2
    EXPECT_NEAR(m->airspace.geofence_m[2].x, -111.2, 0.3);
    EXPECT_NEAR(m->airspace.geofence_m[2].y, 77.2, 0.3);
    EXPECT_EQ(m->airspace.audience_m.size(), 1U);
}

TEST(MissionReader, ReadsObstaclesOfAllKinds) {
    const auto m = parse_with(R"(
[[airspace.obstacle]]
kind = "cylinder"
name = "mast"
center_m = [30, 10]
radius_m = 4
height_m = 25
[[airspace.obstacle]]
kind = "box"
center_m = [40, 10]
size_m = [6, 2]
height_m = 8
base_m = 1
rotate_deg = 90
[[airspace.obstacle]]
kind = "prism"
outline_m = [[50, 0], [60, 0], [60, 10]]
height_m = 5
)");
    ASSERT_TRUE(m.ok()) << message(m);
    ASSERT_EQ(m->airspace.obstacles.size(), 3U);
    EXPECT_EQ(m->airspace.obstacles[0].name, "mast");
    EXPECT_EQ(std::get<geo::Cylinder>(m->airspace.obstacles[0].shape).radius_m, 4.0);
    const auto& box = std::get<geo::Prism>(m->airspace.obstacles[1].shape).outline_m;
    ASSERT_EQ(box.size(), 4U);  // turned by 90 degrees: 2 wide, 6 deep
    for (const Vec2& corner : box) {
        EXPECT_NEAR(std::abs(corner.x - 40.0), 1.0, 1e-12);
        EXPECT_NEAR(std::abs(corner.y - 10.0), 3.0, 1e-12);
    }
    EXPECT_EQ(m->airspace.obstacles[1].base_m, 1.0);
    EXPECT_EQ(std::get<geo::Prism>(m->airspace.obstacles[2].shape).outline_m.size(), 3U);
}

TEST(MissionReader, ReadsWhatArriveSays) {
    const auto m = parse_with(R"([keyframe.arrive]
method = "flow"
assign = "keep"
pins = { 3 = 1, "1" = 3 }
duration_s = 12
profile = "s-curve"
separation = "none"
stagger_s = 0
spectral = { align = "pca", reorder = "greedy", inflate = true }
flow = { tension = 1, corner = true, of = "spectral" }
)");
    ASSERT_TRUE(m.ok()) << message(m);
    const Arrive& a = m->keyframes[0].arrive;
    EXPECT_EQ(a.method, Method::flow);
    EXPECT_EQ(a.assign, Assign::keep);
    const std::map<DroneId, SlotId> pins{{DroneId::from_number(1), SlotId::from_number(3)},
                                         {DroneId::from_number(3), SlotId::from_number(1)}};
    EXPECT_EQ(a.pins, pins);
    EXPECT_EQ(a.duration_s, 12.0);
    EXPECT_EQ(a.profile, ProfileKind::s_curve);
    EXPECT_EQ(a.separation, SeparationMethod::none);
    EXPECT_EQ(a.spectral.align, Align::pca);
    EXPECT_EQ(a.spectral.reorder, Reorder::greedy);
    EXPECT_TRUE(a.spectral.inflate);
    EXPECT_EQ(a.flow.tension, 1.0);
    EXPECT_TRUE(a.flow.corner);
    EXPECT_EQ(a.flow.of, FlowOf::spectral);
}

TEST(MissionReader, ReadsGroupsEditsAndCues) {
    const auto m = parse_with(kGroups + R"([[adjacency]]
between = ["right", 1]
weight = 0
[[cue]]
name = "late"
at_s = 2.0005
[[cue]]
name = "early"
at_s = 1
)");
    ASSERT_TRUE(m.ok()) << message(m);
    ASSERT_EQ(m->groups.size(), 2U);
    EXPECT_EQ(m->groups[0].weight, 10.0);
    EXPECT_EQ(m->groups[1].weight, 3.0);
    EXPECT_THAT(m->groups[1].drones, ElementsAre(DroneId::from_number(3), DroneId::from_number(4)));
    ASSERT_EQ(m->adjacency.size(), 1U);
    EXPECT_EQ(std::get<std::size_t>(m->adjacency[0].first.who), 1U);
    EXPECT_EQ(std::get<DroneId>(m->adjacency[0].second.who), DroneId::from_number(1));
    EXPECT_EQ(m->adjacency[0].weight, 0.0);
    EXPECT_THAT(m->cues, ElementsAre(Cue{1000, "early"}, Cue{2001, "late"}));
}

TEST(MissionReader, PartsShareTheFleetAndTakeTheKeyframesColour) {
    const auto m = parse(kShow + kFleet + kGroups + R"([[keyframe]]
name = "a"
center_m = [1, 2, 20]
rotate_deg = [0, 90, 0]
color = "#f00"
[keyframe.arrive]
assign = "groups"
[[keyframe.part]]
text = "A"
group = "right"
center_m = [5, 0, 0]
[[keyframe.part]]
shape = "circle"
color = "#00f"
)");
    ASSERT_TRUE(m.ok()) << message(m);
    const Keyframe& k = m->keyframes[0];
    EXPECT_EQ(k.center_m, Vec3(1, 2, 20));
    EXPECT_DOUBLE_EQ(k.rotate_rad.y, kPi / 2.0);
    ASSERT_EQ(k.parts.size(), 2U);
    EXPECT_EQ(k.parts[0].drones, 2U);
    EXPECT_EQ(k.parts[0].group, "right");
    EXPECT_EQ(k.parts[0].center_m, Vec3(5, 0, 0));
    EXPECT_EQ(std::get<Rgb>(*k.parts[0].color), (Rgb{1, 0, 0}));
    EXPECT_EQ(k.parts[1].drones, 2U);
    EXPECT_EQ(std::get<Rgb>(*k.parts[1].color), (Rgb{0, 0, 1}));
}

TEST(MissionReader, SizesComeAsListsOrTables) {
    const auto size = [](const std::string& source, const std::string& size_m) {
        const auto m = parse(kShow + kFleet + "[[keyframe]]\nname = \"a\"\n" + source + "\nsize_m = " + size_m + "\n");
        EXPECT_TRUE(m.ok()) << message(m);
        return m ? m->keyframes[0].parts[0].size : Size{};
    };
    const Size width = size("text = \"A\"", "[12]");
    EXPECT_EQ(width.width_m, 12.0);
    EXPECT_FALSE(width.height_m || width.depth_m);
    const Size flat = size("text = \"A\"", "[12, 16]");
    EXPECT_EQ(flat.width_m, 12.0);
    EXPECT_EQ(flat.height_m, 16.0);
    EXPECT_FALSE(flat.depth_m);
    const Size solid = size("shape = \"helix\"", "[1, 2, 3]");
    EXPECT_EQ(solid.width_m, 1.0);
    EXPECT_EQ(solid.depth_m, 2.0);
    EXPECT_EQ(solid.height_m, 3.0);
    const Size table = size("text = \"A\"", "{ height = 16 }");
    EXPECT_FALSE(table.width_m || table.depth_m);
    EXPECT_EQ(table.height_m, 16.0);
}

TEST(MissionReader, FlowPassesKeyframesWithoutHolding) {
    const auto m =
        parse_with("hold_s = 0\n[[keyframe]]\nname = \"b\"\ntext = \"B\"\n[keyframe.arrive]\nmethod = \"flow\"\n");
    ASSERT_TRUE(m.ok()) << message(m);
    EXPECT_EQ(m->keyframes[0].hold_s, 0.0);
}

TEST(MissionReader, AcceptsTheHarmlessValuesOfLaterKeys) {
    const auto m = parse(
        "[show]\nname = \"x\"\nobjective = \"smooth\"\n"
        "origin = { latitude_deg = 46.2, longitude_deg = 6.1, height_m = 400, datum = \"ellipsoid\" }\n"
        "[fleet]\ndrones = 4\nvehicle = \"copter\"\nspares = { where = \"pads\" }\n"
        "pads = { rows = 2, columns = 2, spacing_m = 3 }\n" +
        kKeyframe + "motion = { spin_deg = 0, drift_m = [0, 0, 0] }\n");
    EXPECT_TRUE(m.ok()) << message(m);
}

TEST(MissionReader, TellsAllProblemsInLineOrder) {
    const auto m = parse("[fleet]\ndrones = 0\n[[keyframe]]\nname = \"a\"\nshape = \"cirle\"\n[show]\nnme = \"x\"\n");
    EXPECT_EQ(
        message(m),
        "m.toml:1: fleet.pads: missing; write pads = { rows = 2, columns = 5, spacing_m = 2.5 } or pads = { csv = "
        "\"pads.csv\" }\n"
        "m.toml:2: fleet.drones = 0: must be a whole number from 1 to 100000\n"
        "m.toml:5: keyframe[1].shape = \"cirle\": must be \"line\", \"circle\", \"spiral\", \"disc\", \"ring\", "
        "\"square\", \"polygon\", \"star\", \"heart\", \"grid\", \"wave\", \"sphere\", \"dome\", \"helix\", \"cube\", "
        "\"torus\", \"cylinder\" or \"cone\"; did you mean \"circle\"?\n"
        "m.toml:6: show.name: missing; write name = \"THE END\"\n"
        "m.toml:6: show.origin: missing; write origin = { latitude_deg = 35.6586, longitude_deg = 139.7454, height_m "
        "= 40 }\n"
        "m.toml:7: show.nme = \"x\": unknown key; did you mean name?");
    EXPECT_EQ(m.error().code, ErrorCode::invalid_input);
}

TEST(MissionReader, IndicesCountFromOne) {
    const auto m = parse_with("[[keyframe]]\nname = \"b\"\ntext = \"B\"\nhold_s = -1\n");
    EXPECT_EQ(message(m), "m.toml:14: keyframe[2].hold_s = -1: must be >= 0");
}

TEST(MissionReader, MissingFileIsAnIoError) {
    const auto m = read_mission("no/such/mission.toml");
    ASSERT_FALSE(m.ok());
    EXPECT_EQ(m.error().code, ErrorCode::io);
    EXPECT_EQ(message(m), "no/such/mission.toml:1: there is no such file");
    EXPECT_THAT(message(read_mission(".")), HasSubstr("is a folder"));
}

}  // namespace
}  // namespace aerogram::planner::test
