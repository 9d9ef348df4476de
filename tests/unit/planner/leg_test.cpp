#include "planner/leg.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/motion/certificate.hpp"
#include "small_shows.hpp"

namespace aerogram::planner {
namespace {

using namespace test;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double kRounding_m = 1e-9;

std::vector<std::string> names(const std::vector<Leg>& legs) {
    std::vector<std::string> out;
    for (const Leg& leg : legs) out.push_back(leg.name);
    return out;
}

double farthest(const Points& a, const Points& b) {
    double worst = a.size() == b.size() ? 0.0 : 1e300;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) worst = std::max(worst, glm::distance(a[i], b[i]));
    return worst;
}

double bound_m(const Mission& mission, const Motion& motion) {
    return bound_separation(motion, 1.0, {mission.limits.downwash}, 10.0, aerogram::Run{})->lower_bound_m;
}

/// The only arrival of a mission's keyframe k, planned.
struct Planned {
    Mission mission;
    Leg leg;
    LegMotion motion;
};
Planned arrival(const std::string& keyframes, std::size_t leg = 2, std::size_t drones = 8) {
    Mission mission = show_of(keyframes, drones);
    Stages stages = stages_of(mission);
    return {std::move(mission), stages.legs.at(leg), stages.motions.at(leg)};
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

TEST(PlanLeg, SafeStraightFlightsStayStraight) {
    const Planned a = arrival(keyframe("a", "circle") + keyframe("b", "helix"));
    ASSERT_TRUE(std::holds_alternative<Straight>(a.motion.motion));
    EXPECT_EQ(start_positions(a.motion.motion), a.leg.from_m);
    EXPECT_EQ(end_positions(a.motion.motion), a.leg.to_m);
    EXPECT_EQ(a.motion.report.method, "straight");
    EXPECT_EQ(a.motion.report.separation_by, "");
    EXPECT_EQ(a.motion.report.separation_rounds, 0);
    EXPECT_EQ(a.motion.report.path_ratio, 1.0);
    EXPECT_GT(a.motion.shortest.duration_ms, 0);
    EXPECT_FALSE(a.motion.wanted_s);
}

TEST(PlanLeg, CrossingFlightsAreProjectedApartAndMeetTheirEnds) {
    const Planned a = arrival(keyframe("a", "line") +
                              keyframe("b", "line", kHalfTurn + "arrive = { assign = \"keep\", duration_s = 60 }"));
    ASSERT_TRUE(std::holds_alternative<Lattice>(a.motion.motion));
    EXPECT_GE(bound_m(a.mission, a.motion.motion), planned_separation_m(a.mission.limits));
    EXPECT_LE(farthest(start_positions(a.motion.motion), a.leg.from_m), kRounding_m);
    EXPECT_LE(farthest(end_positions(a.motion.motion), a.leg.to_m), kRounding_m);
    EXPECT_THAT(a.motion.report.separation_by, HasSubstr("projection"));
    EXPECT_GT(a.motion.report.separation_rounds, 0);
    EXPECT_GT(a.motion.report.path_ratio, 1.0);
    EXPECT_EQ(a.motion.wanted_s, 60.0);
}

TEST(PlanLeg, SeparationNoneLeavesCrossingFlightsAsTheyAre) {
    for (const char* method : {"straight", "spectral"}) {
        const Planned a =
            arrival(keyframe("a", "line") + keyframe("b", "line",
                                                     kHalfTurn +
                                                         "arrive = { assign = \"keep\", separation = "
                                                         "\"none\", method = \"" +
                                                         method + "\", spectral = { align = \"none\" } }"));
        EXPECT_LT(bound_m(a.mission, a.motion.motion), planned_separation_m(a.mission.limits)) << method;
        EXPECT_EQ(a.motion.report.separation_rounds, 0);
        EXPECT_EQ(a.motion.report.separation_by, "");
        EXPECT_EQ(a.motion.report.method, method);
    }
}

TEST(PlanLeg, SpectralFlightsMeetTheirEnds) {
    const Planned a = arrival(keyframe("a", "circle") + keyframe("b", "helix", "arrive = { method = \"spectral\" }"));
    ASSERT_TRUE(std::holds_alternative<Lattice>(a.motion.motion));
    EXPECT_LE(farthest(start_positions(a.motion.motion), a.leg.from_m), kRounding_m);
    EXPECT_LE(farthest(end_positions(a.motion.motion), a.leg.to_m), kRounding_m);
    EXPECT_EQ(a.motion.report.method, "spectral");
}

TEST(PlanLeg, FlowsPassKeyframesAtTheirKnots) {
    for (const char* of : {"positions", "spectral"}) {
        const std::string flow = "arrive = { method = \"flow\", flow = { of = \"" + std::string(of) + "\" } }";
        const Mission mission = show_of(keyframe("a", "circle") + keyframe("b", "helix", "hold_s = 0\n" + flow) +
                                        keyframe("c", "sphere", flow));
        const Stages stages = stages_of(mission);
        const LegMotion& motion = stages.motions[2];
        const auto& lattice = std::get<Lattice>(motion.motion);
        ASSERT_EQ(motion.keyframe_knots.size(), 2u);
        EXPECT_EQ(motion.keyframe_knots.back(), interval_count(motion.motion));
        for (std::size_t q = 0; q < 2; ++q) {
            const std::size_t knot = motion.keyframe_knots[q];
            for (std::size_t i = 0; i < 8; ++i) {
                const Vec3 there = knot_value(lattice.at(knot, i), lattice.at(knot + 1, i), lattice.at(knot + 2, i));
                EXPECT_LE(glm::distance(there, stages.route.stops[1 + q].by_drone_m[i]), kRounding_m) << of;
            }
        }
    }
}

TEST(PlanLeg, AFlowHasADurationWhenAllItsLegsHaveOne) {
    const auto wanted = [](const std::string& first, const std::string& second) {
        return arrival(keyframe("a", "circle") +
                       keyframe("b", "helix", "hold_s = 0\narrive = { method = \"flow\"" + first + " }") +
                       keyframe("c", "sphere", "arrive = { method = \"flow\"" + second + " }"))
            .motion.wanted_s;
    };
    EXPECT_EQ(wanted(", duration_s = 20", ", duration_s = 45"), 65.0);
    EXPECT_EQ(wanted(", duration_s = 20", ""), std::nullopt);
    EXPECT_EQ(wanted("", ", duration_s = 45"), std::nullopt);
}

/// Low formations: everybody crosses, and nobody is pushed below the lowest altitude for sideways flight.
TEST(PlanLeg, ProjectionStaysAboveTheMinimumNavigationAltitude) {
    const auto low_line = [](const std::string& name, int turn_deg) {
        return "[[keyframe]]\nname = \"" + name +
               "\"\nshape = \"line\"\nsize_m = [24]\ncenter_m = [0, 0, 3]\nrotate_deg = [0, 0, " +
               std::to_string(turn_deg) + "]\narrive = { assign = \"keep\" }\n";
    };
    const Planned a = arrival(low_line("a", 0) + low_line("b", 170));
    const auto& lattice = std::get<Lattice>(a.motion.motion);
    for (const Vec3& p : lattice.points_m) EXPECT_GE(p.z, a.mission.limits.min_navigation_altitude_m);
    EXPECT_GE(bound_m(a.mission, a.motion.motion), planned_separation_m(a.mission.limits));
}

TEST(PlanLeg, StopIsHonoured) {
    std::stop_source stop;
    stop.request_stop();
    const Mission mission =
        show_of(keyframe("a", "circle") + keyframe("b", "helix", "arrive = { method = \"spectral\" }"));
    const Route route = build_route(mission, aerogram::Run{}).value();
    const auto motion = plan_leg(mission, route, legs_of(mission, route)[2], aerogram::Run{stop.get_token(), {}, 1});
    ASSERT_FALSE(motion);
    EXPECT_EQ(motion.error().code, ErrorCode::stopped);
}

}  // namespace
}  // namespace aerogram::planner
