#pragma once
#include <string>
#include <vector>

#include "planner/carrier/ride.hpp"
#include "planner/mission/mission_reader.hpp"
#include "planner/motion/profile.hpp"

/// Small shows that ride along a route, put together without the planner.
namespace aerogram::planner::test {

inline const std::string kStraightRoute = "waypoints_m = [[-300, 0, 80], [900, 0, 80]]\n";
inline const std::string kCornerRoute = "waypoints_m = [[-300, 0, 80], [300, 0, 80], [300, 600, 80]]\n";

/// @param carrier  keys of [carrier].
inline Mission riders(const std::string& vehicle, const std::string& carrier, std::size_t drones = 3,
                      const std::string& limits = "") {
    return parse_mission(
               "[show]\nname = \"riders\"\norigin = { latitude_deg = 46.2, longitude_deg = 6.1, height_m = "
               "400 }\n[fleet]\ndrones = " +
                   std::to_string(drones) + "\nvehicle = \"" + vehicle +
                   "\"\npads = { rows = 1, columns = 10, spacing_m = 10 }\n[limits]\n" + limits +
                   "[[keyframe]]\nname = \"a\"\nshape = \"line\"\nhold_s = 4.04\n[carrier]\n" + carrier,
               "riders.toml")
        .value();
}
inline Mission planes(const std::string& route, std::size_t drones = 3, const std::string& limits = "") {
    return riders("plane", route + "speed_mps = 18\n", drones, limits);
}
inline Mission copters(const std::string& route, std::size_t drones = 3) {
    return riders("copter", route + "speed_mps = 3\n", drones);
}

/// A row along x, spaced, moved by `by`, as it stands at the start of the route.
inline Points row(const Mission& mission, double spacing_m, const Vec3& by = {}) {
    Points points;
    const Vec3 start = mission.carrier->waypoints_m.front();
    for (std::size_t i = 0; i < mission.fleet.drones; ++i)
        points.push_back(start + by + Vec3{spacing_m * static_cast<double>(i), 0, 0});
    return points;
}
inline Act hold(const std::string& name, const Points& at_m, Millis duration_ms) {
    return {name, ActRole::hold, Timing::fixed, 0, duration_ms, Hold{at_m}};
}
inline Act flight(const Points& from_m, const Points& to_m, Millis duration_ms) {
    return {"to", ActRole::transit, Timing::free,
            0,    duration_ms,      Straight{from_m, to_m, profile_rows(ProfileKind::minimum_jerk, 63)}};
}
inline std::vector<Act> in_order(std::vector<Act> acts, Millis start_ms = 0) {
    for (Act& act : acts) {
        act.start_ms = start_ms;
        start_ms = act.end_ms();
    }
    return acts;
}

}  // namespace aerogram::planner::test
