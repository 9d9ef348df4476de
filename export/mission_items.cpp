#include "export/mission_items.hpp"

#include <algorithm>
#include <cmath>

#include "export/format.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

using planner::Act, planner::ActRole, planner::FlightPlan;

/// Where every drone is when the leading take-off acts end.
Points above_pads_up(const FlightPlan& plan) {
    const auto first = std::ranges::find_if(plan.acts, [](const Act& a) { return a.role != ActRole::takeoff; });
    if (first != plan.acts.begin()) return planner::end_positions(std::prev(first)->motion);
    Points points = plan.pads_m;
    for (Vec3& p : points) p.z += plan.limits.min_navigation_altitude_m;
    return points;
}

/// Where every drone is when the closing landing acts begin.
Points above_pads_down(const FlightPlan& plan) {
    const auto last =
        std::find_if(plan.acts.rbegin(), plan.acts.rend(), [](const Act& a) { return a.role != ActRole::landing; });
    if (last.base() != plan.acts.end()) return planner::start_positions(last.base()->motion);
    Points points = plan.pads_m;
    for (Vec3& p : points) p.z += plan.limits.min_navigation_altitude_m;
    return points;
}

double hold_s(const planner::PlannedKeyframe& keyframe) {
    return std::max(kShortestHold_s, std::round(seconds_from_ms(keyframe.stands_to_ms - keyframe.stands_from_ms)));
}

/// Acts that begin at rest repeat their first control points.
bool begins_in_flight(const Act& act) {
    if (!std::holds_alternative<planner::Lattice>(act.motion)) return false;
    constexpr double kStill_m = 1e-6;
    for (std::size_t i = 0; i < drone_count(act.motion); ++i) {
        const Vec3 way = planner::control_point(act.motion, 2, i) - planner::control_point(act.motion, 0, i);
        if (glm::length(way) > kStill_m) return true;
    }
    return false;
}

bool above_home(int frame) {
    return frame == mav::kGlobalRelative || frame == mav::kGlobalRelativeInt;
}
bool amsl(int frame) {
    return frame == mav::kGlobal || frame == mav::kGlobalInt;
}

}  // namespace

std::string unsuited_for_missions(const FlightPlan& plan) {
    if (!plan.origin.geoid_undulation_m)
        return "planned homes are above mean sea level: the mission needs geoid_undulation_m";
    if (plan.limits.plane) return "planes: they would take off upright and stop at every waypoint";
    if (std::ranges::any_of(plan.acts, begins_in_flight))
        return "a show that rides along a route: its formations do not stand where a waypoint could be";
    const std::size_t items = plan.keyframes.size() + 4;
    if (items > kMostMissionItems)
        return std::to_string(items) + " mission items a drone; at most " + std::to_string(kMostMissionItems) + " fit";
    return {};
}

Result<std::vector<DroneMission>> drone_missions(const FlightPlan& plan) {
    if (std::string why = unsuited_for_missions(plan); !why.empty()) return Error{ErrorCode::invalid_input, why};
    const geo::ShowFrame frame(plan.origin);
    const Points up = above_pads_up(plan), down = above_pads_down(plan);
    std::vector<DroneMission> missions;
    for (std::size_t i = 0; i < plan.drones(); ++i) {
        const Vec3& pad = plan.pads_m[i];
        DroneMission mission{drone_name(i + 1, plan.drones()), frame.to_geodetic(pad), 0.0, {}};
        const auto home_amsl_m = frame.amsl_m(pad);
        if (!home_amsl_m) return home_amsl_m.error();
        mission.home_amsl_m = *home_amsl_m;
        const auto add = [&](const Vec3& place, double seconds, Waypoint::Kind kind) {
            mission.items.push_back({frame.to_geodetic(place), frame.altitude_above(pad, place), seconds, kind});
        };
        add(up[i], 0.0, Waypoint::Kind::takeoff);
        for (const planner::PlannedKeyframe& keyframe : plan.keyframes)
            add(keyframe.formation_m[keyframe.slot_of[i].value], hold_s(keyframe), Waypoint::Kind::fly_to);
        add(down[i], kShortestHold_s, Waypoint::Kind::fly_to);
        add(pad, 0.0, Waypoint::Kind::land);
        missions.push_back(std::move(mission));
    }
    return missions;
}

Result<std::optional<Waypoint>> waypoint_of(const MissionItem& item, const geo::Geodetic& home, double home_amsl_m) {
    constexpr int kFirstCondition = 112;
    const int c = item.command;
    if (c >= kFirstCondition || c == mav::kDelay) return std::optional<Waypoint>{};
    if (c == mav::kReturn) return std::optional(Waypoint{home, 0.0, 0.0, Waypoint::Kind::land});
    const auto refused = [](const std::string& what) { return Error{ErrorCode::invalid_input, what}; };
    const bool stops = c == mav::kWaypoint || c == mav::kLoiterTime || c == mav::kSpline;
    if (!stops && c != mav::kTakeoff && c != mav::kLand)
        return refused("command " + std::to_string(c) +
                       ": only take-off, waypoint, timed loiter, spline, return and land are read");
    if (!above_home(item.frame) && !amsl(item.frame))
        return refused("frame " + std::to_string(item.frame) + ": must be 0 or 5 (AMSL), 3 or 6 (above home)");
    Waypoint waypoint{{item.params[4], item.params[5], 0.0}, item.params[6], 0.0, Waypoint::Kind::fly_to};
    if (amsl(item.frame)) waypoint.altitude_above_home_m -= home_amsl_m;
    if (stops) waypoint.hold_s = item.params[0];
    if (c == mav::kTakeoff) waypoint.kind = Waypoint::Kind::takeoff;
    if (c == mav::kLand) waypoint.kind = Waypoint::Kind::land;
    // Take-off and landing without a place happen where the vehicle is; at the ends of a mission that is home.
    if (!stops && waypoint.place.latitude_deg == 0.0 && waypoint.place.longitude_deg == 0.0) {
        waypoint.place.latitude_deg = home.latitude_deg;
        waypoint.place.longitude_deg = home.longitude_deg;
    }
    const geo::Geodetic& place = waypoint.place;
    if (std::abs(place.latitude_deg) > 90.0 || std::abs(place.longitude_deg) > 180.0)
        return refused("latitude and longitude must be within 90 and 180 degrees");
    if (std::abs(item.params[6]) > 100'000.0) return refused("altitude must be within 100 km");
    if (waypoint.hold_s < 0.0 || waypoint.hold_s > 86'400.0) return refused("hold must be from 0 to 86400 s");
    return std::optional(waypoint);
}

Rounding mission_rounding() {
    Rounding rounding;
    rounding.position_m = 0.0008;  // half of 1e-8 degrees north and east, along an axis between them
    rounding.has_speed = false;
    rounding.has_acceleration = false;
    return rounding;
}

}  // namespace aerogram::exporter
