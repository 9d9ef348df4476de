#include "planner/carrier/ride.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "carried.hpp"
#include "geo/show_frame.hpp"
#include "geo/units.hpp"
#include "planner/carrier/ride_spline.hpp"
#include "planner/motion/certificate.hpp"

namespace aerogram::planner {
namespace {

using test::copters, test::flight, test::hold, test::in_order, test::planes, test::row;
using ::testing::HasSubstr;

Surroundings around(const Mission& mission) {
    return {geo::ShowFrame(mission.origin), mission.airspace, mission.fleet.pads_m, mission.limits};
}

/// What plan() does: lengthens the flights until the ride holds.
Result<Ride> ride_lengthened(const Mission& mission, std::vector<Act> acts) {
    for (int round = 0; round < 60; ++round) {
        auto out = ride(mission, acts, aerogram::Run{});
        if (!out || out->too_fast.empty()) return out;
        for (const TooFast& wish : out->too_fast) acts[wish.act].duration_ms = wish.duration_ms;
        acts = in_order(std::move(acts), acts.front().start_ms);
    }
    return Error{ErrorCode::infeasible, "no end"};
}

TEST(GlidingSpline, Property1And2_MeetsItsSamplesAndGlidesAtConstantVelocity) {
    Points samples, line;
    for (int m = 0; m < 12; ++m) {
        samples.emplace_back(std::sin(0.7 * m), m * m, 1.0 / (1.0 + m));
        line.emplace_back(3.0 * m, -m, 7.0);
    }
    const Lattice wavy = gliding_lattice_through(samples, 1);
    ASSERT_EQ(wavy.rows(), samples.size() + 2);
    for (std::size_t m = 0; m < samples.size(); ++m)
        EXPECT_NEAR(glm::length(knot_value(wavy.at(m, 0), wavy.at(m + 1, 0), wavy.at(m + 2, 0)) - samples[m]), 0.0,
                    1e-12);
    const Lattice glides = gliding_lattice_through(line, 1);
    for (std::size_t k = 0; k + 1 < glides.rows(); ++k)
        EXPECT_NEAR(glm::length(glides.at(k + 1, 0) - glides.at(k, 0) - Vec3(3, -1, 0)), 0.0, 1e-11);
}

TEST(Ride, Property4_PlanesInAStillFormationFlyAtTheCarriersVelocity) {
    const Mission mission = planes(test::kStraightRoute);
    const Ride out = ride(mission, in_order({hold("a", row(mission, 15), 5000)}), aerogram::Run{}).value();
    ASSERT_TRUE(out.too_fast.empty());
    const Kinematics k = kinematics(out.acts[0], DroneId(1), 2.345);
    EXPECT_NEAR(glm::length(k.velocity_mps - Vec3(18, 0, 0)), 0.0, 1e-9);
    EXPECT_NEAR(glm::length(k.position_m - Vec3(-300 + 15 + 18 * 2.345, 0, 80)), 0.0, 1e-9);
    const auto certificate = certify(out.acts[0], around(mission), aerogram::Run{}).value();
    EXPECT_TRUE(certificate.certified()) << certificate.violations.front();
    ASSERT_TRUE(certificate.plane);
    EXPECT_NEAR(certificate.plane->airspeed_min_mps.value, 18.0, 1e-4);
}

// Properties 1 to 3 round a corner, with a flight in it.
TEST(Ride, Property1To3_ActsMeetSmoothlyAndPassTheCarriedPlaces) {
    const Mission mission = planes(test::kCornerRoute);
    const Points a = row(mission, 15), b = row(mission, 12, {0, 20, 25});
    const auto placed = in_order({hold("a", a, 12000), flight(a, b, 16000), hold("b", b, 10000)}, 5000);
    const Ride out = ride(mission, placed, aerogram::Run{}).value();
    ASSERT_EQ(out.acts.size(), placed.size());
    for (std::size_t m = 0; m < placed.size(); ++m) {
        EXPECT_EQ(out.acts[m].name, placed[m].name);
        EXPECT_EQ(out.acts[m].role, placed[m].role);
        EXPECT_EQ(out.acts[m].start_ms, placed[m].start_ms);
        EXPECT_EQ(out.acts[m].duration_ms, placed[m].duration_ms);
        for (Millis t = 0; t <= placed[m].duration_ms; t += 700) {
            Points here(3);
            positions(placed[m], seconds_from_ms(t), here);
            const Vec3 carried = out.carrier.carried(here[2], seconds_from_ms(placed[m].start_ms - 5000 + t));
            EXPECT_NEAR(glm::length(kinematics(out.acts[m], DroneId(2), seconds_from_ms(t)).position_m - carried), 0.0,
                        1e-9);
        }
        if (m == 0) continue;
        const double end_s = seconds_from_ms(out.acts[m - 1].duration_ms);
        const Kinematics before = kinematics(out.acts[m - 1], DroneId(1), end_s),
                         after = kinematics(out.acts[m], DroneId(1), 0);
        EXPECT_NEAR(glm::length(before.position_m - after.position_m), 0.0, 1e-9);
        EXPECT_NEAR(glm::length(before.velocity_mps - after.velocity_mps), 0.0, 1e-8);
        EXPECT_NEAR(glm::length(before.acceleration_mps2 - after.acceleration_mps2), 0.0, 1e-6);
    }
}

TEST(Ride, FlightsAreLengthenedUntilThePlanesHoldTheirLimits) {
    const Mission mission = planes(test::kStraightRoute);
    const Points a = row(mission, 15), b = row(mission, -15, {60, 20, 30});
    const std::vector<Act> hasty = in_order({hold("a", a, 3000), flight(a, b, 4000), hold("b", b, 3000)});
    EXPECT_FALSE(ride(mission, hasty, aerogram::Run{}).value().too_fast.empty());
    const Ride out = ride_lengthened(mission, hasty).value();
    EXPECT_GT(out.acts[1].duration_ms, 8000);
    double fastest = 0.0;
    for (const Act& act : out.acts) {
        EXPECT_EQ(act.duration_ms % 100, 0);
        const auto certificate = certify(act, around(mission), aerogram::Run{}).value();
        // The three cross each other's places on purpose: only their distance is allowed to be wrong.
        for (const std::string& violation : certificate.violations) EXPECT_THAT(violation, HasSubstr("separation"));
        fastest = std::max(fastest, certificate.plane->climb_mps.value);
    }
    EXPECT_GT(fastest, 0.9 * mission.limits.plane->climb_mps);  // no longer than needed
}

TEST(Ride, CoptersStartAndEndAtRestAndHoldTheirLimitsOnTheWay) {
    const Mission mission = copters("waypoints_m = [[0, 0, 40], [60, 0, 40], [60, 80, 45]]\n");
    const Points a = row(mission, 4), b = row(mission, 4, {6, -3, 5});
    const Ride out =
        ride_lengthened(mission, in_order({hold("a", a, 8000), flight(a, b, 1000), hold("b", b, 8000)}, 20000)).value();
    EXPECT_EQ(glm::length(kinematics(out.acts.front(), DroneId(0), 0).velocity_mps), 0.0);
    EXPECT_EQ(glm::length(kinematics(out.acts.back(), DroneId(2), 1e9).velocity_mps), 0.0);
    EXPECT_NEAR(glm::length(kinematics(out.acts.front(), DroneId(0), 0).position_m - a[0]), 0.0, 1e-9);
    for (const Act& act : out.acts) {
        const auto certificate = certify(act, around(mission), aerogram::Run{}).value();
        EXPECT_TRUE(certificate.certified()) << certificate.violations.front();
    }
    EXPECT_NEAR(glm::length(kinematics(out.acts.front(), DroneId(0), 7.0).velocity_mps), 3.0, 1e-3);
}

TEST(Ride, TurningCarrierTurnsTheFormation) {
    Mission mission = planes(test::kCornerRoute);
    mission.carrier->turn = true;
    const Vec3 start = mission.carrier->waypoints_m.front();
    const Points ahead{start, start + Vec3{20, 0, 0},
                       start + Vec3{0, 12, 0}};  // in line with the flight, and to its left
    const Ride out = ride(mission, in_order({hold("a", ahead, 60000)}), aerogram::Run{}).value();
    const auto place = [&](std::size_t i) { return kinematics(out.acts[0], DroneId(i), 59.0).position_m; };
    EXPECT_NEAR(glm::length(place(1) - place(0) - Vec3(0, 20, 0)), 0.0, 1e-6);
    EXPECT_NEAR(glm::length(place(2) - place(0) - Vec3(-12, 0, 0)), 0.0, 1e-6);
}

TEST(Ride, ShortRouteIsRefusedWithLengths) {
    const Mission mission = planes("waypoints_m = [[0, 0, 80], [300, 0, 80]]\n");
    const auto out = ride(mission, in_order({hold("a", row(mission, 15), 20000)}), aerogram::Run{});
    ASSERT_FALSE(out.ok());
    EXPECT_EQ(out.error().code, ErrorCode::infeasible);
    EXPECT_THAT(out.error().message,
                HasSubstr("the route is 300.0 m long with its corners rounded; the show rides 20.0 s on "
                          "it and needs 360.0 m at 18 m/s"));
}

TEST(Ride, HoldThatBreaksALimitIsRefusedByName) {
    Mission mission = planes(test::kCornerRoute);
    mission.carrier->turn = true;  // the outer plane of a wide row flies much faster than the carrier
    const auto out = ride(mission, in_order({hold("wide", row(mission, 60, {0, -120, 0}), 60000)}), aerogram::Run{});
    ASSERT_FALSE(out.ok());
    EXPECT_THAT(out.error().message, HasSubstr("carrier: \"wide\" cannot be flown on this route: "));
    EXPECT_THAT(out.error().message, HasSubstr("of the carrier by itself it is"));
}

TEST(PlacedAtStart, KeyframesStandOnTheRouteAndTimesAreWholeTicks) {
    Mission mission = planes(test::kStraightRoute);
    mission.keyframes[0].at_s = 12.345;
    const Mission placed = placed_at_start(mission).value();
    EXPECT_NEAR(glm::length(placed.keyframes[0].center_m - Vec3(-300, 0, 80)), 0.0, 1e-9);
    EXPECT_DOUBLE_EQ(placed.keyframes[0].hold_s, 4.1);
    EXPECT_DOUBLE_EQ(*placed.keyframes[0].at_s, 12.4);
    EXPECT_EQ(placed.keyframes[0].rotate_rad.z, 0.0);
    mission.carrier->turn = true;
    EXPECT_NEAR(placed_at_start(mission).value().keyframes[0].rotate_rad.z, -0.5 * kPi, 1e-12);
}

}  // namespace
}  // namespace aerogram::planner
