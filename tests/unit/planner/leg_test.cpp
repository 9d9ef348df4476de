#include "planner/leg.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "small_shows.hpp"

namespace aerogram::planner {
namespace {

using namespace test;
using ::testing::ElementsAre;

std::vector<std::string> names(const std::vector<Leg>& legs) {
    std::vector<std::string> out;
    for (const Leg& leg : legs) out.push_back(leg.name);
    return out;
}

TEST(LegsOf, TakeOffArrivalsReturnAndLandingFollowOneAnother) {
    const Mission mission = show_of(keyframe("a", "circle") + keyframe("b", "helix"));
    const Route route = build_route(mission, aerogram::Run{}).value();
    const std::vector<Leg> legs = legs_of(mission, route);
    EXPECT_THAT(names(legs), ElementsAre("take-off", "to a", "to b", "return", "landing"));
    EXPECT_EQ(legs[0].from_m, mission.fleet.pads_m);
    for (std::size_t l = 1; l < legs.size(); ++l) EXPECT_EQ(legs[l].from_m, legs[l - 1].to_m);
    EXPECT_EQ(legs[4].to_m, mission.fleet.pads_m);
    EXPECT_EQ(legs[0].role, ActRole::takeoff);
    EXPECT_EQ(legs[1].role, ActRole::transit);
    EXPECT_EQ(legs[3].role, ActRole::transit);
    EXPECT_EQ(legs[4].role, ActRole::landing);
    EXPECT_TRUE(legs[1].arrives && legs[2].arrives);
    EXPECT_FALSE(legs[0].arrives || legs[3].arrives || legs[4].arrives);
}

TEST(LegsOf, FlowsWithoutAHoldBetweenAreOneLeg) {
    const Mission mission =
        show_of(keyframe("a", "circle") + keyframe("b", "helix", kFlowOn) + keyframe("c", "sphere", kFlowOn) +
                keyframe("d", "circle", kFlow) + keyframe("e", "helix", kFlow));
    const std::vector<Leg> legs = legs_of(mission, build_route(mission, aerogram::Run{}).value());
    EXPECT_THAT(names(legs), ElementsAre("take-off", "to a", "flow to d", "to e", "return", "landing"));
    EXPECT_EQ(legs[2].first, 1u);
    EXPECT_EQ(legs[2].last, 3u);
    EXPECT_EQ(legs[3].first, 4u);
    EXPECT_EQ(legs[3].last, 4u);
}

TEST(LegsOf, AFlowIsOnlyPairwiseWhenEveryMatchingIs) {
    const Mission mission =
        show_of(keyframe("a", "line") +
                keyframe("b", "line", kHalfTurn + "hold_s = 0\narrive = { method = \"flow\", assign = \"keep\" }") +
                keyframe("c", "circle", kFlow));
    const Route route = build_route(mission, aerogram::Run{}).value();
    EXPECT_TRUE(route.stops[2].pairwise);
    EXPECT_FALSE(legs_of(mission, route)[2].pairwise);
}

/// Pads 1 m apart with 1.55 m to keep: drones of a row's neighbours leave one after the other.
TEST(LegsOf, TightPadsAreLeftAndTakenInWaves) {
    Mission mission = show_of(keyframe("a", "circle"));
    for (Vec3& p : mission.fleet.pads_m) p *= 1.0 / 3.0;
    const Route route = build_route(mission, aerogram::Run{}).value();
    EXPECT_EQ(route.layers.count, 4u);
    const std::vector<Leg> legs = legs_of(mission, route);
    EXPECT_THAT(names(legs),
                ElementsAre("take-off 1 of 4", "take-off 2 of 4", "take-off 3 of 4", "take-off 4 of 4", "to a",
                            "return", "landing 1 of 4", "landing 2 of 4", "landing 3 of 4", "landing 4 of 4"));
    EXPECT_EQ(legs[0].from_m, mission.fleet.pads_m);
    for (std::size_t l = 1; l < legs.size(); ++l) EXPECT_EQ(legs[l].from_m, legs[l - 1].to_m);
    EXPECT_EQ(legs.back().to_m, mission.fleet.pads_m);
    double highest_m = 0.0;
    for (std::size_t d = 0; d < 8; ++d) highest_m = std::max(highest_m, legs[0].to_m[d].z);
    EXPECT_DOUBLE_EQ(highest_m, 2.6 + 3 * 1.55);  // the first wave goes to the highest layer
}

TEST(LegsOf, AMovingHoldIsLeftFromWhereItEnds) {
    const Mission mission =
        show_of(keyframe("a", "grid", "motion = { spin_deg = 90, drift_m = [0, 0, 5] }\nhold_s = 20") +
                keyframe("b", "circle"));
    const Route route = build_route(mission, aerogram::Run{}).value();
    const std::vector<Leg> legs = legs_of(mission, route);
    EXPECT_EQ(legs[2].from_m, route.stops[0].left_from_m);
    EXPECT_NE(route.stops[0].left_from_m, route.stops[0].by_drone_m);
}

}  // namespace
}  // namespace aerogram::planner
