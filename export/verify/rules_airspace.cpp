#include <algorithm>
#include <limits>
#include <span>

#include "export/verify/rules.hpp"
#include "export/verify/shapes.hpp"

namespace aerogram::exporter {
namespace {

constexpr Tolerance kMarginTolerance{1e-6, 1e-3};
constexpr Tolerance kSolidTolerance{1e-4, 1e-3};

Vec2 flat(const Vec3& p) {
    return {p.x, p.y};
}

/// A ball around control points. Margins change by at most a metre a metre, so that in it none is below that of its
/// middle less its radius.
struct Ball {
    Vec3 low_m = Vec3(std::numeric_limits<double>::infinity()), high_m = -low_m;

    void include(std::span<const Vec3> controls) {
        for (const Vec3& p : controls) low_m = glm::min(low_m, p), high_m = glm::max(high_m, p);
    }
    template <class Of>
    [[nodiscard]] double margin_bound(const Of& of) const {
        return of(0.5 * (low_m + high_m)) - 0.5 * glm::length(high_m - low_m);
    }
};

constexpr std::size_t kPiecesABall = 16;

/// The pieces whose margin may be below the smallest so far.
template <class Of, class Visit>
void for_each_near(const RecordedDrone& drone, const Of& of, const Worst& worst, const Visit& visit) {
    for (std::size_t first = 0; first < drone.pieces.size(); first += kPiecesABall) {
        const auto pieces = std::span(drone.pieces).subspan(first, std::min(kPiecesABall, drone.pieces.size() - first));
        Ball all;
        for (const Piece& piece : pieces) all.include(controls_of(drone, piece));
        if (all.margin_bound(of) >= worst.bound) continue;
        for (const Piece& piece : pieces) {
            Ball own;
            own.include(controls_of(drone, piece));
            if (own.margin_bound(of) < worst.bound) visit(piece);
        }
    }
}

/// The smallest margin of any drone, over all of the shapes.
template <class Shapes, class Of, class BoundOf>
FleetWorst smallest_margin(const RecordedShow& show, const Run& run, std::string_view stage, const Shapes& shapes,
                           const Tolerance& tolerance, const Of& of, const BoundOf& bound_of) {
    return worst_of_fleet(show.drones, run, stage, [&](const RecordedDrone& drone, Worst& worst) {
        for (const auto& shape : shapes) {
            const auto of_shape = [&](const Vec3& p) { return of(shape, p); };
            const auto bound_of_shape = [&](const Bezier& curve) { return bound_of(shape, curve); };
            for_each_near(drone, of_shape, worst, [&](const Piece& piece) {
                minimise(timed(drone, piece), tolerance, of_shape, bound_of_shape, worst);
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
