#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "export/verify/judge.hpp"
#include "export/waypoint/mission_items.hpp"
#include "tests/unit/export/fixed_show.hpp"

namespace aerogram::exporter {

/// A waypoint format's show of fixed::show() goes where the plan goes, within the stated rounding.
inline void expect_goes_where_the_plan_goes(const RecordedShow& show, double holds_at_a_s = 3.0) {
    const planner::FlightPlan plan = fixed::show();
    const geo::ShowFrame frame(plan.origin);
    EXPECT_FALSE(show.timed || show.rounding.has_speed || show.rounding.has_acceleration);
    ASSERT_EQ(show.drones.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        const RecordedDrone& drone = show.drones[i];
        EXPECT_EQ(drone.name, "drone-00" + std::to_string(i + 1));
        const Points places{fixed::above_pads()[i], fixed::formation_a()[i], fixed::formation_b()[i],
                            fixed::above_pads()[i], fixed::pads()[i]};
        ASSERT_EQ(drone.waypoints.size(), places.size());
        const double home_height_m = drone.home_amsl_m ? *drone.home_amsl_m + *plan.origin.geoid_undulation_m
                                                       : frame.to_geodetic(plan.pads_m[i]).height_m;
        for (std::size_t k = 0; k < places.size(); ++k) {
            const Waypoint& w = drone.waypoints[k];
            const Vec3 place =
                frame.to_show({w.place.latitude_deg, w.place.longitude_deg, home_height_m + w.altitude_above_home_m});
            const Vec3 miss = place - places[k];
            // Home's and the waypoint's heights are both rounded.
            EXPECT_LE(std::max(std::abs(miss.x), std::abs(miss.y)), show.rounding.position_m) << i << " item " << k;
            EXPECT_LE(std::abs(miss.z), 2.0 * show.rounding.position_m) << i << " item " << k;
        }
        EXPECT_EQ(drone.waypoints.front().kind, Waypoint::Kind::takeoff);
        EXPECT_EQ(drone.waypoints[1].kind, Waypoint::Kind::fly_to);
        EXPECT_EQ(drone.waypoints[1].hold_s, holds_at_a_s);
        EXPECT_EQ(drone.waypoints.back().kind, Waypoint::Kind::land);
    }
}

/// The fixed show with its missions' timing. It starts ten seconds before midnight.
inline planner::FlightPlan timed_show(planner::WaypointTiming timing,
                                      planner::Autopilot autopilot = planner::Autopilot::ardupilot) {
    planner::FlightPlan plan = fixed::show();
    plan.exporting.timing = timing;
    plan.exporting.autopilot = autopilot;
    plan.exporting.start_utc_s = parse_utc("2026-12-31T23:59:50Z");
    return plan;
}

/// Waits at the plan's moments in whole seconds: 8, 27, 40.6 and 60.6 s. @param zero_s  what the file counts from.
inline void expect_leaves_when_the_plan_leaves(const RecordedShow& show, double zero_s) {
    EXPECT_EQ(show.timing, "absolute");
    for (const RecordedDrone& drone : show.drones) {
        std::vector<double> waits;
        for (const Waypoint& waypoint : drone.waypoints)
            if (waypoint.until_s) waits.push_back(*waypoint.until_s + zero_s);
        EXPECT_EQ(waits, (std::vector<double>{8.0, 27.0, 41.0, 61.0})) << drone.name;
        EXPECT_FALSE(drone.waypoints.back().until_s.has_value());
    }
}

/// The judge claims the standing fleet, and only that.
inline void expect_standing_is_judged(const RecordedShow& show) {
    JudgeAgainst against;
    against.origin = fixed::show().origin;
    against.airspace = fixed::show().airspace;
    const auto judgement = judge(show, against, aerogram::Run{});
    ASSERT_TRUE(judgement.ok()) << judgement.error().message;
    EXPECT_FALSE(judgement->separation_claimed);
    EXPECT_EQ(judgement->timing, "absolute");
    double standing_m = 0.0;
    for (const Finding& finding : judgement->findings) {
        EXPECT_TRUE(finding.held) << finding.rule << " " << finding.worst << " limit " << finding.limit;
        EXPECT_NE(finding.rule, "separation");
        if (finding.rule == "separation_standing") standing_m = finding.worst;
    }
    double least_m = 1e9;  // of the places, by brute force
    for (const Points& places : {fixed::above_pads(), fixed::formation_a(), fixed::formation_b()})
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < i; ++j) least_m = std::min(least_m, glm::length(places[i] - places[j]));
    EXPECT_NEAR(standing_m, least_m, 0.005);
}

}  // namespace aerogram::exporter
