#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "export/report/report_content.hpp"
#include "export/report/report_words.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

using Shape = std::vector<Vec2>;

Shape circle(const geo::Cylinder& c) {
    constexpr int kCorners = 48;
    Shape shape;
    for (int i = 0; i < kCorners; ++i) {
        const double a = 2.0 * std::numbers::pi * i / kCorners;
        shape.push_back(c.center_m + c.radius_m * Vec2(std::cos(a), std::sin(a)));
    }
    return shape;
}

Shape outline(const geo::Obstacle& obstacle) {
    if (const auto* c = std::get_if<geo::Cylinder>(&obstacle.shape)) return circle(*c);
    return std::get<geo::Prism>(obstacle.shape).outline_m;
}

struct Span {
    double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
};
Span across(const Shape& shape) {
    Span span;
    for (const Vec2& p : shape) span = {std::min(span.low, p.x), std::max(span.high, p.x)};
    return span;
}
Shape upright(const Shape& ground, double low, double high) {
    if (ground.empty()) return {};
    const Span s = across(ground);
    return {{s.low, low}, {s.high, low}, {s.high, high}, {s.low, high}};
}

void add(Plan& plan, Layer layer, const char* name, std::vector<Shape> shapes, std::vector<std::string> labels = {}) {
    std::erase_if(shapes, [](const Shape& s) { return s.empty(); });
    if (!shapes.empty()) plan.layers.push_back({layer, name, std::move(shapes), std::move(labels)});
}

/// Ways or places seen along one axis: x against y from above, x against z from the audience.
Shape seen(const Points& points_m, bool from_above) {
    Shape shape;
    shape.reserve(points_m.size());
    for (const Vec3& p : points_m) shape.emplace_back(p.x, from_above ? p.y : p.z);
    return shape;
}
std::vector<Shape> ways(const Report& report, bool from_above) {
    std::vector<Shape> shapes;
    for (const Points& track : report.tracks_m) shapes.push_back(seen(track, from_above));
    return shapes;
}
std::vector<std::string> obstacle_names(const Report& report) {
    std::vector<std::string> names;
    for (const geo::Obstacle& o : report.airspace.obstacles) names.push_back(o.name);
    return names;
}

Plan from_above(const Report& report) {
    const geo::Airspace& air = report.airspace;
    Plan plan{
        "plan", "Plan: seen from above", "x, to the right of the audience (m)", "y, away from the audience (m)", {},
        {}};
    add(plan, Layer::ground_risk, "ground-risk volume", {report.volumes.ground_risk_m});
    add(plan, Layer::contingency, "contingency volume", {report.volumes.contingency_m});
    add(plan, Layer::flight, "flight volume", {report.volumes.flight_m});
    add(plan, Layer::audience, "audience", air.audience_m);
    std::vector<Shape> obstacles;
    for (const geo::Obstacle& o : air.obstacles) obstacles.push_back(outline(o));
    add(plan, Layer::obstacle, "obstacles", obstacles, obstacle_names(report));
    add(plan, Layer::fence, "geofence", {air.geofence_m});
    add(plan, Layer::track, "ways", ways(report, true));
    add(plan, Layer::home, "homes", {seen(report.homes_m, true)});
    if (report.origin) {
        const double heading = radians(report.origin->heading_deg);
        plan.north = Vec2(-std::sin(heading), std::cos(heading));
    }
    return plan;
}

Plan from_audience(const Report& report) {
    const FlightVolumes& v = report.volumes;
    Plan plan{"elevation", "Elevation: seen from the audience", "x, to the right of the audience (m)", "height (m)", {},
              {}};
    const double top = v.contingency_height_m;
    if (!v.ground_risk_m.empty() && !v.contingency_m.empty()) {
        const Span ground = across(v.ground_risk_m), air = across(v.contingency_m);
        add(plan, Layer::ground_risk, "ground-risk volume",
            {{{ground.low, 0.0}, {ground.high, 0.0}, {air.high, top}, {air.low, top}}});
    }
    add(plan, Layer::contingency, "contingency volume", {upright(v.contingency_m, 0.0, top)});
    add(plan, Layer::flight, "flight volume", {upright(v.flight_m, 0.0, v.flight_height_m)});
    std::vector<Shape> audience, obstacles;
    constexpr double kPeopleHigh_m = 2.0;
    for (const geo::Polygon& area : report.airspace.audience_m) audience.push_back(upright(area, 0.0, kPeopleHigh_m));
    add(plan, Layer::audience, "audience", std::move(audience));
    for (const geo::Obstacle& o : report.airspace.obstacles)
        obstacles.push_back(upright(outline(o), o.base_m, o.base_m + o.height_m));
    add(plan, Layer::obstacle, "obstacles", std::move(obstacles), obstacle_names(report));
    add(plan, Layer::fence, "geofence", {upright(report.airspace.geofence_m, 0.0, report.limits.ceiling_m)});
    add(plan, Layer::track, "ways", ways(report, false));
    add(plan, Layer::home, "homes", {seen(report.homes_m, false)});
    return plan;
}

}  // namespace

Section places_section(const Report& report) {
    const FlightVolumes& v = report.volumes;
    std::string meaning = "Show frame, metres.";
    if (report.tracks_m.size() < report.drones)
        meaning += " Ways are those of " + counted(report.tracks_m.size(), "drone", "drones") + " out of " +
                   count_text(report.drones) + "; volumes and homes are those of all.";
    Section section{"places", "Plan and elevation", meaning, {}};
    section.blocks.emplace_back(from_above(report));
    section.blocks.emplace_back(from_audience(report));
    section.blocks.emplace_back(Facts{
        {{"Flight volume", "up to " + fixed_text(v.flight_height_m, 1) + " m"},
         {"Contingency volume", fixed_text(v.contingency_m_wide, 1) + " m wider, up to " +
                                    fixed_text(v.contingency_height_m, 1) + " m (speed " + fixed_text(v.speed_mps, 1) +
                                    " m/s)"},
         {"Ground-risk volume", fixed_text(v.ground_risk_m_wide, 1) + " m wider again"},
         {"Geofence", report.airspace.geofence_m.empty()
                          ? "none"
                          : counted(report.airspace.geofence_m.size(), "corner", "corners")},
         {"Audience", report.airspace.audience_m.empty() ? "none stated"
                                                         : counted(report.airspace.audience_m.size(), "area", "areas")},
         {"Obstacles", count_text(report.airspace.obstacles.size())}}});
    return section;
}

}  // namespace aerogram::exporter
