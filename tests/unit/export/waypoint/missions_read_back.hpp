#pragma once
#include <gtest/gtest.h>

#include <cmath>

#include "export/waypoint/mission_items.hpp"
#include "tests/unit/export/fixed_show.hpp"

namespace aerogram::exporter {

/// A waypoint format's show of fixed::show() goes where the plan goes, within the stated rounding.
inline void expect_goes_where_the_plan_goes(const RecordedShow& show) {
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
        const double home_height_m = *drone.home_amsl_m + *plan.origin.geoid_undulation_m;
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
        EXPECT_EQ(drone.waypoints[1].hold_s, 3.0);
        EXPECT_EQ(drone.waypoints.back().kind, Waypoint::Kind::land);
    }
}

}  // namespace aerogram::exporter
