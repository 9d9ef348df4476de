#include "export/verify/waypoint_legs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace aerogram::exporter {
namespace {

/// A straight line that is longer is no leg above ground.
constexpr double kFarthest_m = 100'000.0;

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
    const bool unknown = untimed.home->height_m == 0.0;
    if (!untimed.home_amsl_m) return unknown ? frame.origin().ground.height_m : untimed.home->height_m;
    return *untimed.home_amsl_m + frame.origin().geoid_undulation_m.value_or(0.0);
}

/// The file's own fence: the first outline that nobody may leave, and all that nobody may enter.
void take_fence(const GeodeticFence& fence, const geo::ShowFrame& frame, geo::Airspace& airspace) {
    const auto on_ground = [&](const GeodeticFence::Outline& outline) {
        geo::Polygon polygon;
        for (const geo::Geodetic& corner : outline) {
            const Vec3 p = frame.to_show({corner.latitude_deg, corner.longitude_deg, frame.origin().ground.height_m});
            polygon.push_back({p.x, p.y});
        }
        return polygon;
    };
    if (!fence.inside.empty()) airspace.geofence_m = on_ground(fence.inside.front());
    for (const auto& outline : fence.outside) airspace.audience_m.push_back(on_ground(outline));
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

/// When a drone leaves a waypoint that it waits at, and where that is.
struct Wait {
    double until_s = 0.0;
    Vec3 place_m{};
};

std::vector<Wait> waits_of(const RecordedDrone& untimed, const RecordedDrone& legs) {
    std::vector<Wait> waits;
    std::size_t leg = 0;
    for (const Waypoint& waypoint : untimed.waypoints) {
        leg += waypoint.kind == Waypoint::Kind::land ? 2 : 1;
        const Piece& piece = legs.pieces[leg - 1];
        if (waypoint.until_s) waits.push_back({*waypoint.until_s, legs.controls_m[piece.first_control + 1]});
    }
    return waits;
}

using FleetWaits = std::vector<std::vector<Wait>>;

Finding leaving_times(const FleetWaits& fleet) {
    constexpr double kDay_s = 86'400.0;
    Finding finding{"leaving_times", 0.0, 0.0, 0.0, {}, {}, true};
    const auto differs = [&](double by_s, std::size_t drone, double at_s) {
        if (by_s <= finding.worst) return;
        finding.worst = by_s;
        finding.drones = {1, drone + 1};
        finding.time_s = at_s;
    };
    const std::vector<Wait>& first = fleet.front();
    for (std::size_t d = 1; d < fleet.size(); ++d) {
        const std::size_t both = std::min(first.size(), fleet[d].size());
        for (std::size_t k = 0; k < both; ++k)
            differs(std::abs(fleet[d][k].until_s - first[k].until_s), d, first[k].until_s);
        if (first.size() != fleet[d].size()) differs(kDay_s, d, first[both - 1].until_s);
    }
    finding.held = finding.worst <= kNumeric;
    return finding;
}

/// The two closest of a fleet that stands.
struct Closest {
    double apart_m = std::numeric_limits<double>::infinity();
    std::size_t first = 0, second = 0, moment = 0;
};

/// Makes `closest` the closest pair of the fleet at its k-th wait where that is closer; a sweep along the widest axis.
void look_at(const FleetWaits& fleet, std::size_t k, double downwash, Closest& closest) {
    Points places;
    Vec3 low{1e300, 1e300, 1e300}, high = -low;
    for (const std::vector<Wait>& waits : fleet) {
        const Vec3& p = waits[k].place_m;
        places.push_back({p.x, p.y, p.z / downwash});
        low = glm::min(low, places.back());
        high = glm::max(high, places.back());
    }
    const Vec3 wide = high - low;
    const int axis = wide.x >= wide.y && wide.x >= wide.z ? 0 : wide.y >= wide.z ? 1 : 2;
    std::vector<std::size_t> order(places.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t d) { return std::pair(places[d][axis], d); });
    for (std::size_t i = 0; i < order.size(); ++i) {
        for (std::size_t j = i + 1; j < order.size(); ++j) {
            const Vec3 way = places[order[j]] - places[order[i]];
            if (way[axis] >= closest.apart_m) break;
            if (const double apart_m = glm::length(way); apart_m < closest.apart_m)
                closest = {apart_m, std::min(order[i], order[j]), std::max(order[i], order[j]), k};
        }
    }
}

}  // namespace

Result<std::vector<Finding>> standing_findings(const RecordedShow& untimed, const RecordedShow& legs,
                                               const Rules& rules, const Run& run) {
    FleetWaits fleet;
    std::size_t moments = std::numeric_limits<std::size_t>::max();
    for (std::size_t d = 0; d < untimed.drones.size(); ++d) {
        fleet.push_back(waits_of(untimed.drones[d], legs.drones[d]));
        moments = std::min(moments, fleet.back().size());
    }
    if (fleet.size() < 2 || moments == 0) return std::vector<Finding>{};
    Closest closest;
    for (std::size_t k = 0; k < moments; ++k) {
        if (run.stopped()) return stopped_error();
        look_at(fleet, k, rules.limits.downwash, closest);
    }
    const double limit_m = rules.limits.min_separation_m;
    Finding separation{
        "separation_standing", limit_m, closest.apart_m, 0.0, {}, {}, closest.apart_m >= limit_m - kNumeric};
    separation.drones = {closest.first + 1, closest.second + 1};
    separation.time_s = fleet[closest.first][closest.moment].until_s;
    return std::vector<Finding>{leaving_times(fleet), std::move(separation)};
}

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
    for (std::size_t d = 0; d < untimed.drones.size(); ++d) {
        const RecordedDrone& drone = untimed.drones[d];
        const geo::ShowFrame around(geo::ShowOrigin{*drone.home, 0.0, {}});
        for (const Waypoint& waypoint : drone.waypoints) {
            const geo::Geodetic& place = waypoint.place;
            const Vec3 there = around.to_show({place.latitude_deg, place.longitude_deg, drone.home->height_m});
            if (glm::length(there) > kFarthest_m)
                return Error{ErrorCode::invalid_input,
                             "drone " + std::to_string(d + 1) + ": a waypoint is more than 100 km from home"};
        }
    }
    if (!rules.frame) rules.frame.emplace(geo::ShowOrigin{*untimed.drones.front().home, 0.0, {}});
    if (untimed.fence && rules.airspace.geofence_m.empty() && rules.airspace.audience_m.empty())
        take_fence(*untimed.fence, *rules.frame, rules.airspace);
    RecordedShow legs = untimed;
    for (RecordedDrone& drone : legs.drones) drone = legs_of(drone, *rules.frame);
    return legs;
}

}  // namespace aerogram::exporter
