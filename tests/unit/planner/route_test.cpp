#include "planner/route.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "small_shows.hpp"

namespace aerogram::planner {
namespace {

using namespace test;
using ::testing::HasSubstr;

std::string groups_of_four() {
    return "[[group]]\nname = \"left\"\ndrones = \"1-4\"\n[[group]]\nname = \"right\"\ndrones = \"5-8\"\n";
}
std::string part(const std::string& group, double x_m, double z_m, int drones, const std::string& color) {
    return "[[keyframe.part]]\nshape = \"line\"\ngroup = \"" + group + "\"\ndrones = " + std::to_string(drones) +
           "\ncenter_m = [" + std::to_string(x_m) + ", 0, " + std::to_string(z_m) + "]\ncolor = \"" + color + "\"\n";
}
std::string in_parts(const std::string& arrive) {
    return "[[keyframe]]\nname = \"parts\"\narrive = " + arrive + "\n";
}

TEST(Route, FleetIsLiftedStraightAboveItsPads) {
    const Mission mission = show_of(keyframe("a", "circle"));
    const Route route = build_route(mission, aerogram::Run{}).value();
    ASSERT_EQ(route.layers.lifted_m.size(), 8u);
    for (std::size_t d = 0; d < 8; ++d) {
        EXPECT_EQ(Vec2(route.layers.lifted_m[d]), Vec2(mission.fleet.pads_m[d]));
        EXPECT_GT(route.layers.lifted_m[d].z - mission.fleet.pads_m[d].z, mission.limits.min_navigation_altitude_m);
        EXPECT_LT(route.layers.lifted_m[d].z - mission.fleet.pads_m[d].z,
                  mission.limits.min_navigation_altitude_m + 0.2);
    }
}

TEST(Route, EveryStopIsABijectionWithPlacesByDrone) {
    const Mission mission = show_of(keyframe("a", "circle") +
                                    keyframe("b", "sphere", "arrive = { assign = \"keep\" }") + keyframe("c", "helix"));
    const Route route = build_route(mission, aerogram::Run{}).value();
    ASSERT_EQ(route.stops.size(), 3u);
    for (const Stop& stop : route.stops) {
        std::set<SlotId> slots(stop.keyframe.slot_of.begin(), stop.keyframe.slot_of.end());
        EXPECT_EQ(slots.size(), 8u);
        EXPECT_EQ(stop.keyframe.formation_m.size(), 8u);
        EXPECT_EQ(stop.keyframe.colors.size(), 8u);
        for (std::size_t d = 0; d < 8; ++d)
            EXPECT_EQ(stop.by_drone_m[d], stop.keyframe.formation_m[stop.keyframe.slot_of[d].value]);
    }
    EXPECT_EQ(route.stops[0].assignment, "shortest, no paths cross");
    EXPECT_TRUE(route.stops[0].pairwise);
    for (std::size_t d = 0; d < 8; ++d) EXPECT_EQ(route.stops[1].keyframe.slot_of[d], SlotId(d));
}

TEST(Route, CrossingPathsOfKeptSlotsAreReported) {
    const Mission mission =
        show_of(keyframe("a", "line") + keyframe("b", "line", kHalfTurn + "arrive = { assign = \"keep\" }"));
    const Stop stop = build_route(mission, aerogram::Run{})->stops[1];
    EXPECT_FALSE(stop.pairwise);
    EXPECT_EQ(stop.assignment, "keep, paths of drones 1 and 2 cross");
}

TEST(Route, PinnedDronesFlyToTheirSlots) {
    const Mission mission = show_of(keyframe("a", "circle", "arrive = { pins = { 3 = 8, 8 = 1 } }"));
    const auto slot_of = build_route(mission, aerogram::Run{})->stops[0].keyframe.slot_of;
    EXPECT_EQ(slot_of[2], SlotId::from_number(8));
    EXPECT_EQ(slot_of[7], SlotId::from_number(1));
}

/// A group that two parts name takes the slots of both, and nobody else's.
TEST(Route, PartsOfOneGroupAreTakenTogetherByThatGroup) {
    const Mission mission =
        show_of(groups_of_four() + in_parts("{ assign = \"groups\" }") + part("left", 20, 40, 2, "#f00") +
                part("right", -20, 40, 4, "#0f0") + part("left", 20, 60, 2, "#f00"));
    const auto stop = build_route(mission, aerogram::Run{})->stops[0];
    bool low = false, high = false;
    for (std::size_t d = 0; d < 8; ++d) {
        EXPECT_EQ(stop.by_drone_m[d].x > 0.0, d < 4) << "drone " << d + 1;
        low = low || (d < 4 && stop.by_drone_m[d].z < 50.0);
        high = high || (d < 4 && stop.by_drone_m[d].z > 50.0);
    }
    EXPECT_TRUE(low && high);
}

TEST(Route, PartsWithoutAGroupGoToTheGroupsOfTheirSize) {
    const Mission mission =
        show_of("[[group]]\nname = \"few\"\ndrones = \"1-3\"\n" + in_parts("{ assign = \"groups\" }") +
                "[[keyframe.part]]\nshape = \"line\"\ndrones = 5\ncenter_m = [-20, 0, 40]\n"
                "[[keyframe.part]]\nshape = \"line\"\ndrones = 3\ncenter_m = [20, 0, 40]\n");
    const auto stop = build_route(mission, aerogram::Run{})->stops[0];
    for (std::size_t d = 0; d < 8; ++d) EXPECT_EQ(stop.by_drone_m[d].x > 0.0, d < 3) << "drone " << d + 1;
}

TEST(Route, GroupsWithoutPartsOfTheirSizeAreAnErrorAtTheArrivalsLine) {
    const Mission mission = show_of(groups_of_four() + in_parts("{ assign = \"groups\" }") +
                                    "[[keyframe.part]]\nshape = \"line\"\ndrones = 5\ncenter_m = [-20, 0, 40]\n"
                                    "[[keyframe.part]]\nshape = \"line\"\ndrones = 3\ncenter_m = [20, 0, 40]\n");
    const auto route = build_route(mission, aerogram::Run{});
    ASSERT_FALSE(route);
    EXPECT_EQ(route.error().code, ErrorCode::invalid_input);
    EXPECT_THAT(route.error().message, HasSubstr("small.toml:16: keyframe[1].arrive: "));
}

TEST(Route, APinThatLeavesItsGroupIsAnError) {
    const Mission mission = show_of(groups_of_four() + in_parts("{ assign = \"groups\", pins = { 1 = 8, 2 = 1 } }") +
                                    part("left", 20, 40, 4, "#f00") + part("right", -20, 40, 4, "#0f0"));
    const auto route = build_route(mission, aerogram::Run{});
    ASSERT_FALSE(route);
    EXPECT_EQ(route.error().code, ErrorCode::invalid_input);
    EXPECT_THAT(route.error().message, HasSubstr("keyframe[1].arrive: "));
}

TEST(Route, FormationErrorsComeThrough) {
    const auto route =
        build_route(show_of(keyframe("a", "circle") + keyframe("b", "circle", "size_m = [3, 3]")), aerogram::Run{});
    ASSERT_FALSE(route);
    EXPECT_EQ(route.error().code, ErrorCode::invalid_input);
    EXPECT_THAT(route.error().message, HasSubstr("keyframe[2].size_m"));
}

TEST(Route, StopIsHonoured) {
    std::stop_source stop;
    stop.request_stop();
    const auto route = build_route(show_of(keyframe("a", "circle")), aerogram::Run{stop.get_token(), {}, 1});
    ASSERT_FALSE(route);
    EXPECT_EQ(route.error().code, ErrorCode::stopped);
}

}  // namespace
}  // namespace aerogram::planner
