#include "export/verify/claims.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <span>
#include <utility>

#include "export/verify/altitude.hpp"
#include "export/verify/shapes.hpp"

namespace aerogram::exporter {
namespace {

constexpr Tolerance kExact{}, kMargin{1e-6, 1e-3}, kSolid{1e-4, 1e-3};
enum Order : std::size_t { position, velocity, acceleration, jerk, orders };

/// One claim about one drone, written so that `of` must nowhere be below `least`.
struct Question {
    std::string what;
    Order order = position;
    double claimed = 0.0, sign = 1.0, tolerance = 0.0;  ///< claimed values are sign times those of `of`
    std::function<double(const Vec3&)> of;
    std::function<double(const Bezier&)> bound_of;
    Tolerance search = kExact;

    [[nodiscard]] double least() const { return sign * claimed - tolerance; }
};

/// A claim that a convex function is nowhere above a value: no point of a curve exceeds its largest control point.
template <class Convex>
Question nowhere_above(std::string what, Order order, double claimed, double tolerance, Convex convex) {
    const auto bound = [convex](const Bezier& curve) {
        double largest = -std::numeric_limits<double>::infinity();
        for (const Vec3& p : curve.controls()) largest = std::max(largest, convex(p));
        return -largest;
    };
    return {std::move(what), order, claimed, -1.0, tolerance, [convex](const Vec3& p) { return -convex(p); }, bound};
}

void ask_of_motion(const Rules& rules, const Claims& c, double shortest_s, std::vector<Question>& all) {
    const double speed = rules.rounding.speed_allowance_mps + kNumeric;
    const double change = rules.rounding.acceleration_allowance_mps2;
    const auto length = [](const Vec3& v) { return glm::length(v); };
    all.push_back(nowhere_above("max_speed_horizontal_mps", velocity, c.speed_horizontal_mps, speed,
                                [](const Vec3& v) { return std::hypot(v.x, v.y); }));
    all.push_back(
        nowhere_above("max_speed_up_mps", velocity, c.speed_up_mps, speed, [](const Vec3& v) { return v.z; }));
    all.push_back(
        nowhere_above("max_speed_down_mps", velocity, c.speed_down_mps, speed, [](const Vec3& v) { return -v.z; }));
    all.push_back(nowhere_above("max_acceleration_mps2", acceleration, c.acceleration_mps2, change + kNumeric, length));
    // A jerk is the difference of two accelerations over a piece.
    all.push_back(nowhere_above("max_jerk_mps3", jerk, c.jerk_mps3, 2.0 * change / shortest_s + kNumeric, length));
}

/// Exact bounds convert a point of each piece to the ellipsoid; wide ones that suffice save that.
void ask_of_altitude(const Altitude& altitude, const Rules& rules, const Claims& c, std::vector<Question>& all) {
    const double tolerance = rules.axis_m() + kAltitude_m + kNumeric;
    const double most = c.altitude_max_m + tolerance, least = c.altitude_min_m - tolerance;
    all.push_back({"altitude_max_m", position, c.altitude_max_m, -1.0, tolerance,
                   [altitude](const Vec3& p) { return -altitude.of(p); },
                   [altitude, most](const Bezier& curve) {
                       const double rough = altitude.rough(curve.controls()).high;
                       return -(rough <= most ? rough : altitude.range(curve).high);
                   }});
    all.push_back({"altitude_min_m", position, c.altitude_min_m, 1.0, tolerance,
                   [altitude](const Vec3& p) { return altitude.of(p); },
                   [altitude, least](const Bezier& curve) {
                       const double rough = altitude.rough(curve.controls()).low;
                       return rough >= least ? rough : altitude.range(curve).low;
                   }});
}

Vec2 flat(const Vec3& p) {
    return {p.x, p.y};
}

/// @param rules  outlives the questions.
void ask_of_margins(const Rules& rules, const Claims& c, std::vector<Question>& all) {
    const double plane = rules.plane_m() + kNumeric, space = rules.space_m() + kNumeric;
    if (const geo::Polygon& fence = rules.airspace.geofence_m;
        !fence.empty() && c.geofence_margin_m.value_or(-1.0) >= 0.0) {
        all.push_back({"geofence_margin_m", position, *c.geofence_margin_m, 1.0, plane,
                       [&fence](const Vec3& p) { return inner_margin(fence, flat(p)); },
                       [&fence](const Bezier& curve) { return inner_margin_bound(fence, curve); }, kMargin});
    }
    if (c.audience_margin_m.value_or(-1.0) >= 0.0) {
        for (const geo::Polygon& area : rules.airspace.audience_m) {
            all.push_back({"audience_margin_m", position, *c.audience_margin_m, 1.0, plane,
                           [&area](const Vec3& p) { return -inner_margin(area, flat(p)); },
                           [&area](const Bezier& curve) { return outer_margin_bound(area, curve); }, kMargin});
        }
    }
    if (c.obstacle_margin_m.value_or(-1.0) >= 0.0) {
        for (const geo::Obstacle& solid : rules.airspace.obstacles) {
            all.push_back({"obstacle_margin_m", position, *c.obstacle_margin_m, 1.0, space,
                           [&solid](const Vec3& p) { return solid_margin(solid, p); },
                           [&solid](const Bezier& curve) { return solid_margin_bound(solid, curve); }, kSolid});
        }
    }
}

/// The drone's pieces whose middles lie in the stretch.
std::span<const Piece> pieces_in(const RecordedDrone& drone, double begin_s, double end_s) {
    const auto before = [](double t_s) {
        return [t_s](const Piece& piece) { return piece.start_s + 0.5 * piece.duration_s < t_s; };
    };
    const auto first = std::partition_point(drone.pieces.begin(), drone.pieces.end(), before(begin_s));
    return {first, std::partition_point(first, drone.pieces.end(), before(end_s))};
}

/// The claims that one drone breaks, in the order of the questions.
std::vector<BrokenClaim> look_at_drone(const RecordedDrone& drone, std::size_t number, const Rules& rules,
                                       const Claims& claims) {
    const std::span<const Piece> pieces = pieces_in(drone, claims.begin_s, claims.end_s);
    if (pieces.empty()) return {};
    const double shortest_s = std::ranges::min(pieces, {}, &Piece::duration_s).duration_s;
    std::vector<Question> questions;
    ask_of_motion(rules, claims, shortest_s, questions);
    ask_of_altitude(Altitude(rules.frame, home_of(drone)), rules, claims, questions);
    ask_of_margins(rules, claims, questions);
    std::vector<Worst> worst(questions.size());
    for (std::size_t q = 0; q < worst.size(); ++q)
        worst[q].bound = questions[q].least();  // no search where all is well
    for (const Piece& piece : pieces) {
        std::array<Timed, orders> on{Timed{curve_of(drone, piece), piece.start_s, piece.start_s + piece.duration_s}};
        for (std::size_t k = 1; k < orders; ++k) on[k] = rate(on[k - 1]);
        for (std::size_t q = 0; q < questions.size(); ++q)
            minimise(on[questions[q].order], questions[q].search, questions[q].of, questions[q].bound_of, worst[q]);
    }
    std::vector<BrokenClaim> broken;
    for (std::size_t q = 0; q < worst.size(); ++q) {
        if (worst[q].attained >= questions[q].least()) continue;
        broken.push_back(
            {questions[q].what, questions[q].claimed, questions[q].sign * worst[q].attained, number, worst[q].time_s});
    }
    return broken;
}

}  // namespace

std::vector<BrokenClaim> broken_claims(const RecordedShow& show, const Rules& rules, const Claims& claims,
                                       const Run& run) {
    std::vector<std::vector<BrokenClaim>> each(show.drones.size());
    parallel_for(each.size(), run, "verifying the certificate",
                 [&](std::size_t d) { each[d] = look_at_drone(show.drones[d], d, rules, claims); });
    std::vector<BrokenClaim> worst;
    for (const std::vector<BrokenClaim>& of_drone : each) {
        for (const BrokenClaim& broken : of_drone) {
            const auto known = std::ranges::find(worst, broken.what, &BrokenClaim::what);
            if (known == worst.end()) {
                worst.push_back(broken);
            } else if (std::abs(broken.found - broken.claimed) > std::abs(known->found - known->claimed)) {
                *known = broken;
            }
        }
    }
    return worst;
}

}  // namespace aerogram::exporter
