#include "export/verify/waypoint_legs.hpp"

#include <cmath>

namespace aerogram::exporter {
namespace {

bool on_earth(const geo::Geodetic& place) {
    return std::abs(place.latitude_deg) <= 90.0 && std::abs(place.longitude_deg) <= 180.0 &&
           std::abs(place.height_m) <= 1e6;
}

void line_to(RecordedDrone& drone, const Vec3& from, const Vec3& to) {
    drone.pieces.push_back(
        {static_cast<double>(drone.pieces.size()), 1.0, static_cast<std::uint32_t>(drone.controls_m.size()), 1});
    drone.controls_m.push_back(from);
    drone.controls_m.push_back(to);
}

/// Of a drone's home, above the ellipsoid. Without an undulation AMSL stands in: differences are kept.
double home_height_m(const RecordedDrone& untimed, const geo::ShowFrame& frame) {
    if (!untimed.home_amsl_m) return untimed.home->height_m;
    return *untimed.home_amsl_m + frame.origin().geoid_undulation_m.value_or(0.0);
}

RecordedDrone legs_of(const RecordedDrone& untimed, const geo::ShowFrame& frame) {
    RecordedDrone drone;
    drone.name = untimed.name;
    drone.land_m = untimed.land_m;
    drone.tracks = untimed.tracks;
    geo::Geodetic place = *untimed.home;
    const double home_m = home_height_m(untimed, frame);
    const auto at_height = [&](double altitude_m) {
        return frame.to_show({place.latitude_deg, place.longitude_deg, home_m + altitude_m});
    };
    Vec3 at = at_height(0.0);
    double altitude_m = 0.0;
    drone.home_m = at;
    const auto fly = [&](double to_altitude_m) {
        const Vec3 next = at_height(to_altitude_m);
        line_to(drone, at, next);
        at = next;
        altitude_m = to_altitude_m;
    };
    for (const Waypoint& waypoint : untimed.waypoints) {
        if (waypoint.kind != Waypoint::Kind::takeoff) place = waypoint.place;
        fly(waypoint.kind == Waypoint::Kind::land ? altitude_m : waypoint.altitude_above_home_m);
        if (waypoint.kind == Waypoint::Kind::land) fly(0.0);
    }
    return drone;
}

}  // namespace

Result<RecordedShow> legs_as_pieces(const RecordedShow& untimed, Rules& rules) {
    for (std::size_t d = 0; d < untimed.drones.size(); ++d) {
        const RecordedDrone& drone = untimed.drones[d];
        const std::string name = "drone " + std::to_string(d + 1);
        if (!drone.home)
            return Error{ErrorCode::invalid_input, name + ": the file holds no home to count altitudes from"};
        if (drone.waypoints.empty()) return Error{ErrorCode::invalid_input, name + ": has no waypoints"};
        bool sound = on_earth(*drone.home);
        for (const Waypoint& waypoint : drone.waypoints) {
            sound = sound && on_earth(waypoint.place) && std::abs(waypoint.altitude_above_home_m) <= 1e6;
        }
        if (!sound) return Error{ErrorCode::invalid_input, name + ": a waypoint or the home is not on earth"};
    }
    if (!rules.frame) rules.frame.emplace(geo::ShowOrigin{*untimed.drones.front().home, 0.0, {}});
    RecordedShow legs = untimed;
    for (RecordedDrone& drone : legs.drones) drone = legs_of(drone, *rules.frame);
    return legs;
}

}  // namespace aerogram::exporter
