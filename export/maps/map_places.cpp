#include "export/maps/map_places.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "export/bytes/decimal.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

constexpr int kDegreeDigits = 9, kHeightDigits = 3;
constexpr int kTangents = 48;

geo::Polygon counter_clockwise(geo::Polygon outline) {
    double area = 0.0;
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const Vec2 &a = outline[k], &b = outline[(k + 1) % outline.size()];
        area += a.x * b.y - a.y * b.x;
    }
    if (area < 0.0) std::ranges::reverse(outline);
    return outline;
}

/// A regular polygon around a circle.
geo::Polygon around(const geo::Cylinder& cylinder) {
    geo::Polygon outline;
    const double reach_m = cylinder.radius_m / std::cos(kPi / kTangents);
    for (int k = 0; k < kTangents; ++k) {
        const double angle_rad = 2.0 * kPi * k / kTangents;
        outline.push_back(cylinder.center_m + reach_m * Vec2(std::cos(angle_rad), std::sin(angle_rad)));
    }
    return outline;
}

}  // namespace

UtcSeconds map_start(const OutgoingFacts& facts) {
    return facts.exporting.start_utc_s.value_or(kMapEpoch_s);
}

void MapPlaces::append(std::string& out, const Vec3& show_m, char separator) const {
    const geo::Geodetic place = frame_.to_geodetic(show_m);
    const double origin_deg = frame_.origin().ground.longitude_deg;
    append_fixed(out, origin_deg + std::remainder(place.longitude_deg - origin_deg, 360.0), kDegreeDigits);
    out += separator;
    append_fixed(out, place.latitude_deg, kDegreeDigits);
    out += separator;
    append_fixed(out, place.height_m - below_m_, kHeightDigits);
}

std::string MapPlaces::ring(const geo::Polygon& outline_m, double z_m, std::string_view between, bool closed) const {
    std::string text;
    const std::size_t corners = outline_m.size() + (closed ? 1 : 0);
    for (std::size_t k = 0; k < corners; ++k) {
        const Vec2& p = outline_m[k % outline_m.size()];
        if (k > 0) text += between;
        append(text, {p.x, p.y, z_m}, ',');
    }
    return text;
}

std::vector<MapArea> map_areas(const OutgoingFacts& facts, const FlightVolumes& volumes) {
    std::vector<MapArea> areas;
    const auto add = [&](std::string kind, std::string name, const geo::Polygon& outline_m, double base_m, double top_m,
                         std::string_view fill, std::string_view stroke) {
        if (outline_m.size() < 3) return;
        areas.push_back({std::move(kind), std::move(name), counter_clockwise(outline_m), base_m, top_m, fill, stroke});
    };
    add("flight", "Flight geography", volumes.flight_m, 0.0, volumes.flight_height_m, "2e9e5b40", "2e9e5bff");
    add("contingency", "Contingency volume", volumes.contingency_m, 0.0, volumes.contingency_height_m, "f2c14e30",
        "f2c14eff");
    add("ground-risk", "Ground-risk buffer", volumes.ground_risk_m, 0.0, 0.0, "d6404530", "d64045ff");
    add("geofence", "Geofence", facts.airspace.geofence_m, 0.0, facts.limits.ceiling_m, "3a7bd518", "3a7bd5ff");
    for (std::size_t k = 0; k < facts.airspace.audience_m.size(); ++k)
        add("audience", "Audience " + std::to_string(k + 1), facts.airspace.audience_m[k], 0.0, 0.0, "8e44ad50",
            "8e44adff");
    for (const geo::Obstacle& obstacle : facts.airspace.obstacles) {
        const auto* cylinder = std::get_if<geo::Cylinder>(&obstacle.shape);
        add("obstacle", obstacle.name,
            cylinder != nullptr ? around(*cylinder) : std::get<geo::Prism>(obstacle.shape).outline_m, obstacle.base_m,
            obstacle.base_m + obstacle.height_m, "55555590", "222222ff");
    }
    return areas;
}

void append_exact(std::string& out, double value) {
    std::array<char, 32> text{};
    out.append(text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr);
}

}  // namespace aerogram::exporter
