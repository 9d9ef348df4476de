#include "export/waypoint/departures.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "export/outgoing/planned_show.hpp"
#include "geo/random.hpp"
#include "geo/units.hpp"
#include "tests/unit/export/fixed_show.hpp"

namespace aerogram::exporter {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr UtcSeconds kStart = 1'800'000'000;

planner::FlightPlan plan_at(std::optional<UtcSeconds> start_utc_s) {
    planner::FlightPlan plan = fixed::show();
    plan.exporting.timing = planner::WaypointTiming::absolute;
    plan.exporting.start_utc_s = start_utc_s;
    return plan;
}
Result<Departures> of(const planner::FlightPlan& plan) {
    const PlannedShow show(plan);
    return departures(show.facts(), stops_of(show));
}
std::string refusal(const planner::FlightPlan& plan) {
    const auto found = of(plan);
    return found ? "none" : found.error().message;
}

TEST(Departures, AreThePlansMomentsInWholeSeconds) {
    const Departures found = of(plan_at(kStart)).value();
    EXPECT_EQ(found.start_utc_s, kStart);
    EXPECT_THAT(found.leave_s, ElementsAre(8, 27, 41, 61));  // 8, 27, 40.6 and 60.6 s
}

TEST(Departures, StopsAreThePlansPlacesAndTimes) {
    const planner::FlightPlan plan = plan_at(kStart);
    const Stops stops = stops_of(PlannedShow(plan));
    EXPECT_THAT(stops.names, ElementsAre("take-off", "A", "B", "return"));
    EXPECT_THAT(stops.from_ms, ElementsAre(8'000, 24'000, 36'600, 60'600));
    EXPECT_THAT(stops.to_ms, ElementsAre(8'000, 27'000, 40'600, 60'600));
    for (const double drift_m : stops.drifts_m) EXPECT_LT(drift_m, 1e-9);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_LT(glm::length(stops.places_m[i][0] - fixed::above_pads()[i]), 1e-9);
        EXPECT_LT(glm::length(stops.places_m[i][2] - fixed::formation_b()[i]), 1e-9);
        EXPECT_LT(glm::length(stops.places_m[i][3] - fixed::above_pads()[i]), 1e-9);
    }
}

/// The last to start climbs, hovers the slack and leaves with all others; nobody waits on the ground.
TEST(Departures, MissionsStartInAWindowThatEndsInTime) {
    planner::FlightPlan plan = plan_at(kStart);
    const Departures found = of(plan).value();
    const LegModel model = leg_model(plan.exporting, plan.limits);
    double climb_s = 0.0;
    for (std::size_t i = 0; i < 3; ++i)
        climb_s = std::max(climb_s, takeoff_needs_s(model, fixed::above_pads()[i].z - fixed::pads()[i].z));
    EXPECT_EQ(found.last_start_utc_s, kStart + 8 - static_cast<std::int64_t>(std::ceil(climb_s + 2.0)));
    EXPECT_EQ(found.last_start_utc_s - found.first_start_utc_s, kStartWindow_s);
}

TEST(Departures, NeedAStart) {
    EXPECT_EQ(refusal(plan_at({})), "timing = absolute needs start_utc or --start-utc");
    EXPECT_EQ(refusal(plan_at(60)), "start_utc must be a day inside of 1970 to 9999");
}

TEST(Departures, RefuseALegThatComesLateAndSayWhatWouldDo) {
    planner::FlightPlan plan = plan_at(kStart);
    plan.exporting.leg_speed_mps = 1.5;
    const std::string why = refusal(plan);
    EXPECT_THAT(why, HasSubstr("would come late to \"A\": from \"take-off\" it needs "));
    EXPECT_THAT(why, HasSubstr(" s and 2.0 s of slack, 19 s are there (8 s to 27 s); leave it "));
    EXPECT_THAT(why, HasSubstr(" s later (hold_s or at_s), or allow faster legs or less slack ([export])"));
}

/// A flow's keyframe is a stop like any other: fine with time, refused without.
TEST(Departures, StopAtAFlowsKeyframesOnlyWithTimeToDoSo) {
    planner::FlightPlan plan = plan_at(kStart);
    plan.keyframes[0].stands_to_ms = plan.keyframes[0].stands_from_ms;
    EXPECT_THAT(of(plan).value().leave_s, ElementsAre(8, 24, 41, 61));
    plan.keyframes[1].stands_from_ms = plan.keyframes[1].stands_to_ms = 33'000;
    plan.keyframes[1].formation_m = {{-7.0, 30.0, 14.0}, {2.0, -4.0, 11.0}, {9.5, 1.0, 21.0}};
    plan.acts[4].motion = planner::Hold{plan.keyframes[1].formation_m};
    EXPECT_THAT(refusal(plan), HasSubstr("moves while it is shown"));  // the lattice of this test ends elsewhere
}

/// They would climb side by side.
TEST(Departures, RefusePadsThatThePlanStaggers) {
    planner::FlightPlan plan = plan_at(kStart);
    plan.pads_m[1] = {0.6, -20.8, 0.0};
    EXPECT_EQ(refusal(plan),
              "pads are 1.00 m apart: the plan staggers its take-offs, missions that wait for times climb at once");
}

TEST(Departures, RefuseAFormationThatMovesWhileItIsShown) {
    planner::FlightPlan plan = plan_at(kStart);
    plan.keyframes[0].stands_to_ms += 4'000;
    EXPECT_EQ(refusal(plan), "\"A\" moves while it is shown; vehicles that wait for a time stand");
}

TEST(Departures, TheReturnIsLaterWhereTheWayHomeNeedsIt) {
    planner::FlightPlan plan = plan_at(kStart);
    const PlannedShow show(plan);
    OutgoingFacts facts = show.facts();
    Stops stops = stops_of(show);
    facts.landing_begin_ms = stops.from_ms[3] = stops.to_ms[3] = 45'000;
    const LegModel model = leg_model(plan.exporting, plan.limits);
    double needs_s = 0.0;
    for (const Points& places : stops.places_m) needs_s = std::max(needs_s, leg_needs_s(model, places[3] - places[2]));
    const Departures found = departures(facts, stops).value();
    EXPECT_EQ(found.leave_s[3], 41 + static_cast<std::int64_t>(std::ceil(needs_s + 2.0)));
    EXPECT_GT(found.leave_s[3], 45);
    facts.endurance_s = seconds_from_ms(facts.duration_ms) + 3.0;
    EXPECT_THAT(departures(facts, stops).error().message, HasSubstr("beyond the endurance of"));
}

/// Against the sum of its parts for random shows: accepted exactly when every leg has its slack.
TEST(Departures, Property1And2_AcceptExactlyWhatHasSlack) {
    const planner::FlightPlan plan = plan_at(kStart);
    const PlannedShow show(plan);
    Random random(5);
    std::size_t accepted = 0;
    constexpr int kShows = 400;
    for (int n = 0; n < kShows; ++n) {
        OutgoingFacts facts = show.facts();
        facts.exporting.slack_s = random.between(0.0, 6.0);
        facts.endurance_s = 1e5;
        Stops stops;
        stops.names = {"take-off", "A", "B", "C", "return"};
        Millis at_ms = 5'000;
        for (std::size_t k = 0; k < 5; ++k) {
            stops.from_ms.push_back(at_ms);
            stops.to_ms.push_back(at_ms);
            at_ms += static_cast<Millis>(random.between(9'000.0, 30'000.0));
        }
        stops.drifts_m.assign(5, 0.0);
        for (std::size_t i = 0; i < 3; ++i) {
            Points places;
            for (std::size_t k = 0; k < 5; ++k)
                places.push_back({random.between(-25.0, 25.0), random.between(-25.0, 25.0), random.between(5.0, 30.0)});
            stops.places_m.push_back(places);
        }
        const LegModel model = leg_model(facts.exporting, facts.limits);
        bool in_time = true;
        for (std::size_t k = 1; k < 4; ++k) {
            const auto leave = [&](std::size_t stop) { return std::floor(seconds_from_ms(stops.to_ms[stop]) + 0.5); };
            for (const Points& places : stops.places_m) {
                const Vec3 way = places[k] - places[k - 1];
                const double needs_s = s_curve_s(model, leg_speed_mps(model, way), glm::length(way)) + 1.5;
                in_time = in_time && leave(k) - leave(k - 1) >= needs_s + facts.exporting.slack_s;
            }
        }
        const auto found = departures(facts, stops);
        EXPECT_EQ(found.ok(), in_time) << n << (found ? "" : " " + found.error().message);
        accepted += found ? 1u : 0u;
        if (!found) continue;
        for (std::size_t k = 1; k < 5; ++k)
            for (const Points& places : stops.places_m)
                EXPECT_GE(static_cast<double>(found->leave_s[k] - found->leave_s[k - 1]),
                          leg_needs_s(model, places[k] - places[k - 1]) + facts.exporting.slack_s);
    }
    EXPECT_GT(accepted, 20u);
    EXPECT_LT(accepted, kShows - 20u);
}

}  // namespace
}  // namespace aerogram::exporter
