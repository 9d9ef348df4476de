#include "export/verify/rules.hpp"
#include "export/verify/shapes.hpp"

namespace aerogram::exporter {
namespace {

constexpr Tolerance kMarginTolerance{1e-6, 1e-3};
constexpr Tolerance kSolidTolerance{1e-4, 1e-3};

Vec2 flat(const Vec3& p) {
    return {p.x, p.y};
}

/// The smallest margin of any drone, over all of the shapes.
template <class Shapes, class Of, class BoundOf>
FleetWorst smallest_margin(const RecordedShow& show, const Run& run, std::string_view stage, const Shapes& shapes,
                           const Tolerance& tolerance, const Of& of, const BoundOf& bound_of) {
    return worst_of_fleet(show.drones, run, stage, [&](const RecordedDrone& drone, Worst& worst) {
        for (const auto& shape : shapes) {
            for_each_piece(drone, [&](const Timed& on) {
                minimise(
                    on, tolerance, [&](const Vec3& p) { return of(shape, p); },
                    [&](const Bezier& curve) { return bound_of(shape, curve); }, worst);
            });
        }
    });
}

}  // namespace

std::vector<Finding> airspace_findings(const RecordedShow& show, const Rules& rules, const Run& run) {
    std::vector<Finding> found;
    const auto add = [&](std::string rule, double allowance, const FleetWorst& margin) {
        for (Finding& finding : at_least(std::move(rule), 0.0, allowance, margin)) found.push_back(std::move(finding));
    };
    if (!rules.airspace.geofence_m.empty()) {
        const std::array<geo::Polygon, 1> fence{rules.airspace.geofence_m};
        add("geofence", rules.plane_m(),
            smallest_margin(
                show, run, "verifying the geofence", fence, kMarginTolerance,
                [](const geo::Polygon& outline, const Vec3& p) { return inner_margin(outline, flat(p)); },
                inner_margin_bound));
    }
    add("audience", rules.plane_m(),
        smallest_margin(
            show, run, "verifying the audience", rules.airspace.audience_m, kMarginTolerance,
            [](const geo::Polygon& outline, const Vec3& p) { return -inner_margin(outline, flat(p)); },
            outer_margin_bound));
    add("obstacles", rules.space_m(),
        smallest_margin(show, run, "verifying obstacles", rules.airspace.obstacles, kSolidTolerance, solid_margin,
                        solid_margin_bound));
    return found;
}

}  // namespace aerogram::exporter
