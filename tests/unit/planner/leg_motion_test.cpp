#include "planner/leg_motion.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "planner/motion/certificate.hpp"
#include "small_shows.hpp"

namespace aerogram::planner {
namespace {

using namespace test;
using ::testing::HasSubstr;

constexpr double kRounding_m = 1e-9;

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

/// Flows of more than 26 legs ended in a broken contract; a flow that comes back to where it began had a path ratio of
/// 5e8, flown length over the distance between its ends.
TEST(PlanLeg, LongFlowsThatComeBackAreFlown) {
    const auto ring = [](int k, const std::string& more) {
        const double angle = 2.0 * 3.141592653589793 * k / 40.0;
        return "[[keyframe]]\nname = \"k" + std::to_string(k) + "\"\nshape = \"line\"\ncenter_m = [" +
               std::to_string(30.0 * std::cos(angle)) + ", " + std::to_string(30.0 * std::sin(angle)) + ", 40]\n" +
               more + "\n";
    };
    std::string keyframes = ring(0, "");
    for (int k = 1; k <= 40; ++k)
        keyframes +=
            ring(k, std::string(k < 40 ? "hold_s = 0\n" : "") + "arrive = { method = \"flow\", assign = \"slots\" }");
    const Planned a = arrival(keyframes);
    EXPECT_EQ(a.motion.keyframe_knots.size(), 40U);
    EXPECT_LE(farthest(end_positions(a.motion.motion), start_positions(a.motion.motion)), 1e-5);
    EXPECT_GT(a.motion.report.path_ratio, 0.999);
    EXPECT_LT(a.motion.report.path_ratio, 1.05) << "an arc of 9 degrees is 0.1 % longer than its chord";
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

TEST(PlanLeg, RigidFlightsMeetTheirEnds) {
    const Planned a = arrival(keyframe("a", "circle") + keyframe("b", "helix", "arrive = { method = \"rigid\" }"));
    ASSERT_TRUE(std::holds_alternative<Lattice>(a.motion.motion));
    EXPECT_LE(farthest(start_positions(a.motion.motion), a.leg.from_m), kRounding_m);
    EXPECT_LE(farthest(end_positions(a.motion.motion), a.leg.to_m), kRounding_m);
    EXPECT_GE(bound_m(a.mission, a.motion.motion), planned_separation_m(a.mission.limits));
    EXPECT_EQ(a.motion.report.method, "rigid");
}

TEST(PlanLeg, MoreSeparationIsKeptWhereTheMissionAsksForIt) {
    const std::string asked = "arrive = { min_separation_m = 2.0, assign = \"keep\" }";
    const Planned a = arrival(keyframe("a", "line") + keyframe("b", "line", kHalfTurn + asked));
    EXPECT_DOUBLE_EQ(a.motion.report.required_separation_m, 2.05);
    EXPECT_GE(bound_m(a.mission, a.motion.motion), 2.05 - kSeparationTolerance_m);
}

/// The last drone starts two seconds after the first, and all arrive in the act's own time.
TEST(PlanLeg, StaggeredStartsAreApartByTheSecondsAskedFor) {
    const Planned a = arrival(
        "[[keyframe]]\nname = \"a\"\nshape = \"line\"\nsize_m = [28]\ncenter_m = [0, 0, 40]\n"
        "[[keyframe]]\nname = \"b\"\nshape = \"line\"\nsize_m = [28]\ncenter_m = [60, 0, 40]\n"
        "arrive = { assign = \"keep\", stagger_s = 2.0 }\n");
    ASSERT_TRUE(a.motion.fixed);
    const double total_s = static_cast<double>(a.motion.shortest.duration_ms) / 1000.0;
    EXPECT_EQ(a.motion.wanted_s, total_s);
    const Act act{"", ActRole::transit, Timing::fixed, 0, a.motion.shortest.duration_ms, a.motion.motion};
    const auto time_at_half_way = [&](std::size_t drone) {
        double low_s = 0.0, high_s = total_s;
        const double half_m = 0.5 * (a.leg.from_m[drone].x + a.leg.to_m[drone].x);
        while (high_s - low_s > 1e-6) {
            const double middle_s = 0.5 * (low_s + high_s);
            (kinematics(act, DroneId(drone), middle_s).position_m.x < half_m ? low_s : high_s) = middle_s;
        }
        return low_s;
    };
    const auto [left, right] = std::minmax_element(a.leg.from_m.begin(), a.leg.from_m.end(),
                                                   [](const Vec3& p, const Vec3& q) { return p.x < q.x; });
    const auto number = [&](auto it) { return static_cast<std::size_t>(it - a.leg.from_m.begin()); };
    EXPECT_NEAR(time_at_half_way(number(left)) - time_at_half_way(number(right)), 2.0, 0.02);  // the foremost first
    EXPECT_GE(bound_m(a.mission, a.motion.motion), planned_separation_m(a.mission.limits) - kSeparationTolerance_m);
    EXPECT_LE(shortest_duration(a.motion.motion, a.mission.limits).duration_ms, a.motion.shortest.duration_ms);
}

/// Two groups that swap sides: as bodies their inner distances stay.
TEST(PlanLeg, GroupsMoveAsBodiesInTheirOwnWay) {
    const std::string head =
        "[[group]]\nname = \"left\"\ndrones = \"1-4\"\n[[group]]\nname = \"right\"\ndrones = \"5-8\"\n";
    const std::string two =
        "[[keyframe.part]]\nshape = \"line\"\nsize_m = [9]\ncenter_m = [-20, 0, 0]\ndrones = 4\n"
        "[[keyframe.part]]\nshape = \"line\"\nsize_m = [9]\ncenter_m = [20, 0, 0]\ndrones = 4\n";
    const Planned a =
        arrival(head + "[[keyframe]]\nname = \"a\"\ncenter_m = [0, 0, 40]\narrive = { assign = \"keep\" }\n" + two +
                "[[keyframe]]\nname = \"b\"\ncenter_m = [0, 30, 40]\nrotate_deg = [0, 0, 90]\n"
                "arrive = { method = \"rigid\", assign = \"keep\", separation = \"none\", groups = { left = "
                "{ method = \"rigid\" }, right = { method = \"rigid\" } } }\n" +
                two);
    const Act act{"", ActRole::transit, Timing::free, 0, 10000, a.motion.motion};
    Points now(8);
    for (int k = 0; k <= 20; ++k) {
        positions(act, 0.5 * k, now);
        for (std::size_t i = 0; i < 8; ++i) {
            for (std::size_t j = i + 1; j < i / 4 * 4 + 4; ++j)
                EXPECT_NEAR(glm::distance(now[i], now[j]), glm::distance(a.leg.from_m[i], a.leg.from_m[j]), 1e-2);
        }
    }
}

TEST(PlanLeg, AutoFliesTheBestCertifiedCandidateAndSaysWhy) {
    const std::string turn = keyframe("a", "grid") + keyframe("b", "grid",
                                                              "rotate_deg = [0, 140, 0]\narrive = { method = "
                                                              "\"auto\", assign = \"keep\" }\n");
    const auto planned_for = [&](Objective objective) {
        Mission mission = show_of(turn);
        mission.objective = objective;
        const Stages stages = stages_of(mission);
        return stages.motions[2].report;
    };
    const LegReport together = planned_for(Objective::together);
    EXPECT_EQ(together.method, "auto: rigid");  // a turned body keeps every distance
    EXPECT_THAT(together.chosen_because, HasSubstr("objective together: straight "));
    EXPECT_THAT(together.chosen_because, HasSubstr("; rigid "));
    EXPECT_THAT(together.chosen_because, HasSubstr("; spectral "));
    EXPECT_EQ(planned_for(Objective::shortest).method.rfind("auto: ", 0), 0u);
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
