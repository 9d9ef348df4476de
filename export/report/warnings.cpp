#include <algorithm>
#include <array>
#include <cstdio>

#include "export/report/parts.hpp"

/// What breaks no limit of flight, and what the pilot must weigh all the same.
namespace aerogram::exporter {
namespace {

constexpr double kNothing_m2 = 1e-6, kNothing_m = 1e-3;

double cross(const Vec2& a, const Vec2& b) {
    return a.x * b.y - a.y * b.x;
}

/// The part of a polygon to the left of the line from a to b (Sutherland and Hodgman 1974).
geo::Polygon left_of(const geo::Polygon& polygon, const Vec2& a, const Vec2& b) {
    geo::Polygon kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        const double side_p = cross(b - a, p - a), side_q = cross(b - a, q - a);
        if (side_p >= 0.0) kept.push_back(p);
        if ((side_p > 0.0 && side_q < 0.0) || (side_p < 0.0 && side_q > 0.0))
            kept.push_back(p + (side_p / (side_p - side_q)) * (q - p));
    }
    return kept;
}

/// @param convex  counter-clockwise.
bool overlap(const geo::Polygon& convex, geo::Polygon other) {
    for (std::size_t i = 0; i < convex.size() && !other.empty(); ++i)
        other = left_of(other, convex[i], convex[(i + 1) % convex.size()]);
    double area_m2 = 0.0;
    for (std::size_t i = 0; i < other.size(); ++i) area_m2 += 0.5 * cross(other[i], other[(i + 1) % other.size()]);
    return std::abs(area_m2) > kNothing_m2;
}

std::string beyond_fence(const char* volume, const geo::Polygon& outline, const geo::Polygon& fence) {
    if (fence.empty()) return {};
    double least_m = 0.0;
    for (const Vec2& corner : outline) least_m = std::min(least_m, geo::signed_distance(fence, corner));
    if (least_m > -kNothing_m) return {};
    std::array<char, 160> text{};
    std::snprintf(text.data(), text.size(), "the %s volume reaches %.1f m beyond the geofence", volume, -least_m);
    return text.data();
}

}  // namespace

void report_warnings(Report& report) {
    const auto add = [&](std::string text) {
        if (!text.empty()) report.warnings.push_back(std::move(text));
    };
    for (const ReportRule& rule : report.rules) {
        if (rule.held) continue;
        if (rule.rule == "reserve") add("the energy reserve that is wanted is not kept (an estimate)");
        if (rule.rule == "flashes") add("the fleet's light flashes more than three times in a second");
    }
    const FlightVolumes& v = report.volumes;
    const auto over_audience = [&](const geo::Polygon& volume) {
        return std::ranges::any_of(report.airspace.audience_m,
                                   [&](const geo::Polygon& audience) { return overlap(volume, audience); });
    };
    if (over_audience(v.contingency_m)) {
        add("audience stands in the contingency volume");
    } else if (over_audience(v.ground_risk_m)) {
        add("audience stands in the ground-risk volume");
    }
    add(beyond_fence("contingency", v.contingency_m, report.airspace.geofence_m));
}

}  // namespace aerogram::exporter
