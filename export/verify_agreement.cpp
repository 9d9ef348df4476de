#include "export/verify_agreement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "geo/limits.hpp"

namespace aerogram::exporter {
namespace {

constexpr double kNumeric = 1e-6;
constexpr double kFence_m = 0.01;  ///< corners in eight decimals of a degree, and the bend of the ground
constexpr double kWaitRounding_s = 0.5, kWaitStep_s = 0.05;
constexpr double kResolved_m = 1e-4;  ///< of two separations: SeparationSearch::resolved_m and a margin
constexpr double kSampleEvery_s = 0.25;
constexpr double kMostSamples = 4e6;  ///< of all drones together
constexpr double kFewestTimes = 50.0;
/// Waypoints of a level leg and geodetic conversions at other heights agree to this.
constexpr double kWaypointSlack_m = 0.005;
// Origins are stored in whole 1e-7 degrees and millimetres; headings in all digits.
constexpr double kOriginPlace_deg = 1e-7, kOriginHeight_m = 1e-3, kOriginHeading_deg = 1e-9;

std::string shown(double value) {
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), "%.4g", value);
    return text.data();
}

bool equal(const Vec2& a, const Vec2& b) {
    return a.x == b.x && a.y == b.y;
}
bool equal(const geo::Polygon& a, const geo::Polygon& b) {
    return std::ranges::equal(a, b, [](const Vec2& p, const Vec2& q) { return equal(p, q); });
}
bool equal(const geo::Cylinder& a, const geo::Cylinder& b) {
    return equal(a.center_m, b.center_m) && a.radius_m == b.radius_m;
}
bool equal(const geo::Prism& a, const geo::Prism& b) {
    return equal(a.outline_m, b.outline_m);
}
bool equal(const geo::Obstacle& a, const geo::Obstacle& b) {
    if (a.name != b.name || a.base_m != b.base_m || a.height_m != b.height_m) return false;
    if (a.shape.index() != b.shape.index()) return false;
    return std::visit([&](const auto& shape) { return equal(shape, std::get<std::decay_t<decltype(shape)>>(b.shape)); },
                      a.shape);
}
bool equal(const geo::Airspace& a, const geo::Airspace& b) {
    const auto same = [](const auto& p, const auto& q) { return equal(p, q); };
    return equal(a.geofence_m, b.geofence_m) && std::ranges::equal(a.audience_m, b.audience_m, same) &&
           std::ranges::equal(a.obstacles, b.obstacles, same);
}
bool equal(const geo::ShowOrigin& a, const geo::ShowOrigin& b) {
    return a.ground.latitude_deg == b.ground.latitude_deg && a.ground.longitude_deg == b.ground.longitude_deg &&
           a.ground.height_m == b.ground.height_m && a.heading_deg == b.heading_deg &&
           a.geoid_undulation_m == b.geoid_undulation_m;
}
bool equal(const Limits& a, const Limits& b) {
    constexpr std::array kAll{&Limits::min_separation_m,
                              &Limits::formation_spacing_m,
                              &Limits::downwash,
                              &Limits::export_margin_m,
                              &Limits::speed_horizontal_mps,
                              &Limits::speed_up_mps,
                              &Limits::speed_down_mps,
                              &Limits::acceleration_mps2,
                              &Limits::jerk_mps3,
                              &Limits::min_navigation_altitude_m,
                              &Limits::ceiling_m};
    return a.plane == b.plane && std::ranges::all_of(kAll, [&](const auto limit) { return a.*limit == b.*limit; });
}
bool equal(const Rounding& a, const Rounding& b) {
    return a.position_m == b.position_m && a.fit_m == b.fit_m && a.time_s == b.time_s && a.has_speed == b.has_speed &&
           a.has_acceleration == b.has_acceleration &&
           (!a.has_speed || a.speed_allowance_mps == b.speed_allowance_mps) &&
           (!a.has_acceleration || a.acceleration_allowance_mps2 == b.acceleration_allowance_mps2);
}

double space_m(const Rounding& rounding) {
    return std::sqrt(3.0) * rounding.position_m + rounding.fit_m;
}

/// How far two shows may have one drone apart.
double allowed_distance_m(const Rounding& a, const Rounding& b, const Limits& limits) {
    const double fastest_mps =
        limits.plane ? limits.plane->airspeed_max_mps
                     : std::hypot(limits.speed_horizontal_mps, std::max(limits.speed_up_mps, limits.speed_down_mps));
    return space_m(a) + space_m(b) + kNumeric + (a.time_s + b.time_s) * fastest_mps;
}

/// Names and pads; the first that differs.
Problems drones_disagree(const RecordedShow& show, const Manifest& manifest) {
    if (show.drones.size() != manifest.drones.size()) {
        return {std::to_string(show.drones.size()) + " drones; the manifest lists " +
                std::to_string(manifest.drones.size())};
    }
    const geo::ShowFrame frame(manifest.origin);
    const double allowed_m = space_m(show.rounding) + kNumeric;
    for (std::size_t d = 0; d < show.drones.size(); ++d) {
        const RecordedDrone& drone = show.drones[d];
        const ManifestDrone& listed = manifest.drones[d];
        const std::string name = "drone " + std::to_string(d + 1);
        if (drone.name != listed.name)
            return {name + " is named \"" + drone.name + "\", in the manifest \"" + listed.name + "\""};
        const auto off_pad_m = [&](const std::optional<Vec3>& place) {
            return place ? glm::length(*place - listed.pad_m) : 0.0;
        };
        double off_m = off_pad_m(drone.home_m);
        if (drone.home) {
            const geo::Geodetic pad = frame.to_geodetic(listed.pad_m);
            off_m = glm::length(frame.to_show({drone.home->latitude_deg, drone.home->longitude_deg, pad.height_m}) -
                                listed.pad_m);
        }
        if (off_m > allowed_m) return {name + ": home is " + shown(off_m) + " m from its pad in the manifest"};
        if (off_pad_m(drone.land_m) > allowed_m) {
            return {name + ": its landing place is " + shown(off_pad_m(drone.land_m)) +
                    " m from its pad in the manifest"};
        }
    }
    return {};
}

/// Whether a fence on the globe is the manifest's, corner by corner.
bool is_fence_of(const GeodeticFence& fence, const Manifest& manifest) {
    const geo::ShowFrame frame(manifest.origin);
    const auto same = [&](const GeodeticFence::Outline& held, const geo::Polygon& exact) {
        return std::ranges::equal(held, exact, [&](const geo::Geodetic& corner, const Vec2& p) {
            const geo::Geodetic place = frame.to_geodetic({p.x, p.y, 0.0});
            const Vec3 off = frame.to_show({corner.latitude_deg, corner.longitude_deg, place.height_m}) - Vec3(p, 0.0);
            return std::hypot(off.x, off.y) <= kFence_m;
        });
    };
    const geo::Airspace& exact = manifest.airspace;
    const std::size_t inside = exact.geofence_m.empty() ? 0 : 1;
    return fence.inside.size() == inside && (inside == 0 || same(fence.inside.front(), exact.geofence_m)) &&
           std::ranges::equal(fence.outside, exact.audience_m, same);
}

/// The way round from one angle to another, degrees, 0..180.
double turn_deg(double a_deg, double b_deg) {
    return std::abs(std::remainder(a_deg - b_deg, 360.0));
}

/// How an origin that a format holds in its own digits differs from the exact one, or empty. A heading that is off
/// turns the whole show.
std::string origin_off(const geo::ShowOrigin& held, const geo::ShowOrigin& exact) {
    const auto differs = [](const char* what, double a, double b) {
        std::array<char, 120> text{};
        std::snprintf(text.data(), text.size(), "the origin's %s is %.10g, in the manifest %.10g", what, a, b);
        return std::string(text.data());
    };
    const geo::Geodetic &a = held.ground, &b = exact.ground;
    if (std::abs(a.latitude_deg - b.latitude_deg) > kOriginPlace_deg)
        return differs("latitude", a.latitude_deg, b.latitude_deg);
    if (turn_deg(a.longitude_deg, b.longitude_deg) > kOriginPlace_deg)
        return differs("longitude", a.longitude_deg, b.longitude_deg);
    if (std::abs(a.height_m - b.height_m) > kOriginHeight_m) return differs("height", a.height_m, b.height_m);
    if (held.geoid_undulation_m != exact.geoid_undulation_m)
        return differs("geoid undulation", held.geoid_undulation_m.value_or(0.0),
                       exact.geoid_undulation_m.value_or(0.0));
    if (turn_deg(held.heading_deg, exact.heading_deg) > kOriginHeading_deg)
        return differs("heading", held.heading_deg, exact.heading_deg);
    return {};
}

/// How far a drone is, at the nearest, from where it should wait until t_s, which was rounded to whole seconds.
double off_wait_m(const RecordedDrone& flies, double until_s, const Vec3& place) {
    double nearest_m = std::numeric_limits<double>::infinity();
    for (double t_s = until_s - kWaitRounding_s; t_s <= until_s + kWaitRounding_s; t_s += kWaitStep_s)
        nearest_m = std::min(nearest_m, glm::length(position_at(flies, t_s) - place));
    return nearest_m;
}

Problems places_disagree(const RecordedShow& reference, const RecordedShow& show, const geo::ShowOrigin& origin) {
    const geo::ShowFrame frame(origin);
    const double allowed_m = space_m(reference.rounding) + space_m(show.rounding) + kWaypointSlack_m;
    for (std::size_t d = 0; d < show.drones.size(); ++d) {
        const RecordedDrone& flies = reference.drones[d];
        const Vec3 home = flies.home_m.value_or(first_position(flies));
        const double home_height_m = frame.to_geodetic(home).height_m;
        for (std::size_t w = 0; w < show.drones[d].waypoints.size(); ++w) {
            const Waypoint& waypoint = show.drones[d].waypoints[w];
            if (waypoint.kind != Waypoint::Kind::fly_to) continue;
            const Vec3 place = frame.to_show({waypoint.place.latitude_deg, waypoint.place.longitude_deg,
                                              home_height_m + waypoint.altitude_above_home_m});
            double nearest_m = glm::length(last_position(flies) - place);
            for (const Piece& piece : flies.pieces) {
                nearest_m = std::min(nearest_m, glm::length(flies.controls_m[piece.first_control] - place));
            }
            // Formats whose waits are in show time; the last may be later than the show.
            const bool waits = waypoint.until_s && show.format == "qgc" && w + 2 < show.drones[d].waypoints.size();
            if (waits) nearest_m = std::max(nearest_m, off_wait_m(flies, *waypoint.until_s, place));
            if (nearest_m <= allowed_m) continue;
            return {"drone " + std::to_string(d + 1) + ": waypoint " + std::to_string(w + 1) + " is " +
                    shown(nearest_m) + " m from where " + reference.format + " goes (" + shown(allowed_m) +
                    " m may differ)"};
        }
    }
    return {};
}

}  // namespace

bool is_paper(std::string_view format) {
    return format == "certificate" || std::ranges::find(kPapers, format) != kPapers.end();
}

void complete_from(const Manifest& manifest, RecordedShow& show) {
    show.limits = manifest.limits;
    show.airspace = manifest.airspace;
    show.origin = manifest.origin;
    show.endurance_s = manifest.endurance_s;
    Points pads_m;
    for (const ManifestDrone& drone : manifest.drones) pads_m.push_back(drone.pad_m);
    state_missing_places(show, pads_m);
}

Problems disagreement_of_separations(const RecordedShow& reference, double reference_m, const RecordedShow& show,
                                     double separation_m, const Limits& limits) {
    if (show.drones.size() < 2) return {};
    const double allowed_m = 2.0 * allowed_distance_m(reference.rounding, show.rounding, limits) + kResolved_m;
    if (std::abs(separation_m - reference_m) <= allowed_m) return {};
    return {"the smallest separation is " + shown(separation_m) + " m, in " + reference.format + " " +
            shown(reference_m) + " m (" + shown(allowed_m) + " m may differ)"};
}

Problems disagreement_with_manifest(const RecordedShow& show, const Manifest& manifest) {
    Problems problems = drones_disagree(show, manifest);
    const auto require = [&](bool same, const std::string& what) {
        if (!same) problems.push_back(what + " differs from the manifest");
    };
    require(!show.show_hash || *show.show_hash == manifest.show_hash, "the show hash");
    require(!show.certified || *show.certified == manifest.certified, "the certified mark");
    const auto format = std::ranges::find(manifest.formats, show.format, &ManifestFormat::name);
    require(format != manifest.formats.end() && equal(format->rounding, show.rounding), "the stated rounding");
    require(!show.fence || is_fence_of(*show.fence, manifest), "the fence");
    if (show.format != "trajectories") {
        const std::string off = show.origin ? origin_off(*show.origin, manifest.origin) : std::string();
        if (!off.empty()) problems.push_back(off);
        if (show.format == "skyc") {
            require(show.origin.has_value() == manifest.origin.geoid_undulation_m.has_value(),
                    "whether there is a location");
        }
        return problems;
    }
    require(show.show_hash.has_value(), "the show hash");
    require(show.title == manifest.show_name, "the show's name");
    require(show.limits && equal(*show.limits, manifest.limits), "a limit");
    require(show.airspace && equal(*show.airspace, manifest.airspace), "the airspace");
    require(show.origin && equal(*show.origin, manifest.origin), "the origin");
    require(show.endurance_s == manifest.endurance_s, "the endurance");
    require(show.duration_s == manifest.duration_s, "the duration");
    return problems;
}

Problems disagreement_of_shows(const RecordedShow& reference, const RecordedShow& show, const Limits& limits,
                               const geo::ShowOrigin& origin) {
    if (reference.drones.size() != show.drones.size()) return {};  // said against the manifest
    if (!show.timed) return places_disagree(reference, show, origin);
    const auto fleet = static_cast<double>(show.drones.size());
    const double length_s = std::max(reference.duration_s, show.duration_s);
    const auto times = static_cast<std::size_t>(
        std::clamp(std::min(length_s / kSampleEvery_s, kMostSamples / fleet), kFewestTimes, kMostSamples));
    const double allowed_m = allowed_distance_m(reference.rounding, show.rounding, limits);
    double worst_m = 0.0, worst_s = 0.0;
    std::size_t worst_drone = 0;
    for (std::size_t d = 0; d < show.drones.size(); ++d) {
        for (std::size_t k = 0; k <= times; ++k) {
            const double t = length_s * (static_cast<double>(k) / static_cast<double>(times));
            const double off_m = glm::length(position_at(reference.drones[d], t) - position_at(show.drones[d], t));
            if (off_m <= worst_m + kNumeric) continue;
            worst_m = off_m;
            worst_s = t;
            worst_drone = d;
        }
    }
    if (worst_m <= allowed_m) return {};
    return {"drone " + std::to_string(worst_drone + 1) + " at " + shown(worst_s) + " s is " + shown(worst_m) +
            " m from where " + reference.format + " has it (" + shown(allowed_m) + " m may differ)"};
}

}  // namespace aerogram::exporter
