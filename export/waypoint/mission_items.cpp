#include "export/waypoint/mission_items.hpp"

#include <algorithm>
#include <cmath>

#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

double hold_s(const OutgoingKeyframe& keyframe) {
    return std::max(kShortestHold_s, std::round(seconds_from_ms(keyframe.stands_to_ms - keyframe.stands_from_ms)));
}

bool above_home(int frame) {
    return frame == mav::kGlobalRelative || frame == mav::kGlobalRelativeInt;
}
bool amsl(int frame) {
    return frame == mav::kGlobal || frame == mav::kGlobalInt;
}

}  // namespace

std::string unsuited_for_missions(const OutgoingShow& show) {
    const OutgoingFacts& facts = show.facts();
    if (!facts.origin) return "its place on the globe is not known";
    if (!facts.origin->geoid_undulation_m)
        return "planned homes are above mean sea level: the mission needs geoid_undulation_m";
    if (facts.limits.plane) return "planes: they would take off upright and stop at every waypoint";
    if (facts.rides) return "a show that rides along a route: its formations do not stand where a waypoint could be";
    const std::size_t items = facts.keyframes.size() + 4;
    if (items > kMostMissionItems)
        return std::to_string(items) + " mission items a drone; at most " + std::to_string(kMostMissionItems) + " fit";
    return {};
}

Result<std::vector<DroneMission>> drone_missions(const OutgoingShow& show) {
    if (std::string why = unsuited_for_missions(show); !why.empty()) return Error{ErrorCode::invalid_input, why};
    const OutgoingFacts& facts = show.facts();
    const geo::ShowFrame frame(*facts.origin);
    std::vector<DroneMission> missions;
    for (std::size_t i = 0; i < show.drones(); ++i) {
        const Vec3& pad = facts.drones[i].home_m;
        const Flight flight = show.flight(i);
        FlightCursor cursor(flight);
        DroneMission mission{facts.drones[i].name, frame.to_geodetic(pad), 0.0, {}};
        const auto home_amsl_m = frame.amsl_m(pad);
        if (!home_amsl_m) return home_amsl_m.error();
        mission.home_amsl_m = *home_amsl_m;
        const auto add = [&](const Vec3& place, double seconds, Waypoint::Kind kind) {
            mission.items.push_back({frame.to_geodetic(place), frame.altitude_above(pad, place), seconds, kind});
        };
        const Vec3 low{0.0, 0.0, facts.limits.min_navigation_altitude_m};
        const bool climbs = facts.takeoff_end_ms > 0, sinks = facts.landing_begin_ms < facts.duration_ms;
        add(climbs ? cursor.position_at(seconds_from_ms(facts.takeoff_end_ms)) : pad + low, 0.0,
            Waypoint::Kind::takeoff);
        for (const OutgoingKeyframe& keyframe : facts.keyframes)
            add(keyframe.places_m[i], hold_s(keyframe), Waypoint::Kind::fly_to);
        add(sinks ? cursor.position_at(seconds_from_ms(facts.landing_begin_ms)) : pad + low, kShortestHold_s,
            Waypoint::Kind::fly_to);
        add(facts.drones[i].land_m, 0.0, Waypoint::Kind::land);
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
