#include "export/outgoing/volumes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "geo/contract.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

constexpr double kGravity_mps2 = 9.80665;
/// How far a curve's control polygon may be outside of places that were flown; below the millimetre that is promised.
constexpr double kMiss_m = 0.0005;
/// Corners that stand out no more than this are left out; together with kMiss_m below the millimetre too.
constexpr double kFlat_m = 0.0003;
/// Half the width that a fleet gets which flies above one line or one point.
constexpr double kThin_m = 0.005;
/// Corners are rounded by tangents so close that these are at most 1 % farther away than the arc.
constexpr double kLongestArc_rad = 0.28;
constexpr int kDeepest = 40;

double cross(const Vec2& a, const Vec2& b) {
    return a.x * b.y - a.y * b.x;
}

/// Andrew's monotone chain: the strictly convex hull, counter-clockwise from its leftmost point; one or two points
/// where all lie on a line.
geo::Polygon hull_of(std::vector<Vec2> points) {
    std::ranges::sort(points, [](const Vec2& a, const Vec2& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3) return points;
    geo::Polygon hull;
    const auto append = [&](const Vec2& p, std::size_t keep) {
        while (hull.size() > keep &&
               cross(hull[hull.size() - 1] - hull[hull.size() - 2], p - hull[hull.size() - 2]) <= 0.0)
            hull.pop_back();
        hull.push_back(p);
    };
    for (const Vec2& p : points) append(p, 1);
    const std::size_t lower = hull.size();
    for (std::size_t k = points.size() - 1; k-- > 0;) append(points[k], lower);
    hull.pop_back();
    return hull;
}

double distance_to_segment(const Vec2& a, const Vec2& b, const Vec2& p) {
    const Vec2 d = b - a;
    const double square = glm::dot(d, d);
    const double u = square > 0.0 ? std::clamp(glm::dot(p - a, d) / square, 0.0, 1.0) : 0.0;
    return glm::length(p - (a + u * d));
}

/// Whether a place is inside a hull or within kMiss_m of it, in log n: the wedge of its first corner that holds the
/// place tells the only edge that can be between the two.
bool inside(const geo::Polygon& hull, const Vec2& p) {
    if (hull.size() < 3) return distance_to_segment(hull.front(), hull.back(), p) <= kMiss_m;
    const Vec2 &corner = hull.front(), from_corner = p - corner;
    const auto left_of = [&](const Vec2& q) { return cross(q - corner, from_corner) >= 0.0; };
    const auto begin = hull.begin() + 1;
    const auto beyond = std::partition_point(begin, hull.end(), left_of);
    if (beyond == begin) return distance_to_segment(corner, hull[1], p) <= kMiss_m;
    if (beyond == hull.end()) return distance_to_segment(corner, hull.back(), p) <= kMiss_m;
    const Vec2 &a = *(beyond - 1), &b = *beyond;
    return cross(b - a, p - a) >= 0.0 || distance_to_segment(a, b, p) <= kMiss_m;
}

/// What is known so far of where the fleet flies; only places that a drone is really at.
struct Reach {
    std::vector<Vec2> over;
    double height_m = -std::numeric_limits<double>::infinity();

    void visit(const Vec3& p) {
        over.emplace_back(p.x, p.y);
        height_m = std::max(height_m, p.z);
    }
};

Bezier curve_of(const Flight& flight, const Piece& piece) {
    Bezier curve;
    curve.degree = piece.degree;
    std::copy_n(flight.controls_m.begin() + piece.first_control, curve.degree + 1, curve.control.begin());
    return curve;
}

/// The ends of a flight's pieces; a flight of another program may jump between two.
Reach ends_of(const Flight& flight) {
    Reach reach;
    for (const Piece& piece : flight.pieces) {
        reach.visit(flight.controls_m[piece.first_control]);
        if (piece.degree > 0) reach.visit(flight.controls_m[piece.first_control + piece.degree]);
    }
    reach.over = hull_of(std::move(reach.over));
    return reach;
}

/// Adds places of a curve until it stays within kMiss_m of what was reached: a curve is in the hull of its controls, so
/// it is halved until these are near the fleet's hull or near the chord of the half.
void extend(const Bezier& curve, const Reach& fleet, Reach& found, int depth) {
    const Vec2 a(curve.front()), b(curve.back());
    const double top_m = std::max({fleet.height_m, curve.front().z, curve.back().z}) + kMiss_m;
    const bool held = std::ranges::all_of(curve.controls(), [&](const Vec3& c) {
        const Vec2 p(c);
        return c.z <= top_m && (distance_to_segment(a, b, p) <= kMiss_m || inside(fleet.over, p));
    });
    if (held || depth == kDeepest) return;
    const auto [first, second] = split(curve, 0.5);
    found.visit(second.front());
    extend(first, fleet, found, depth + 1);
    extend(second, fleet, found, depth + 1);
}

Reach united(std::vector<Reach>& parts) {
    Reach all;
    for (Reach& part : parts) {
        all.over.insert(all.over.end(), part.over.begin(), part.over.end());
        all.height_m = std::max(all.height_m, part.height_m);
        part = {};
    }
    all.over = hull_of(std::move(all.over));
    return all;
}

Reach reach_of(const OutgoingShow& show, const Run& run) {
    std::vector<Reach> parts(show.drones());
    parallel_for(show.drones(), run, "volumes", [&](std::size_t i) { parts[i] = ends_of(show.flight(i)); });
    const Reach ends = united(parts);
    if (ends.over.empty()) return ends;
    parallel_for(show.drones(), run, "volumes", [&](std::size_t i) {
        const Flight flight = show.flight(i);
        for (const Piece& piece : flight.pieces) extend(curve_of(flight, piece), ends, parts[i], 0);
        parts[i].over = hull_of(std::move(parts[i].over));
    });
    parts.push_back(ends);
    return united(parts);
}

/// A convex polygon without the corners that hardly stand out: those between two that stay are within kFlat_m of the
/// line between these. One or two points of what is as good as a line.
geo::Polygon plain(const geo::Polygon& convex) {
    constexpr std::size_t kMostSkipped = 64;
    const std::size_t n = convex.size();
    geo::Polygon kept;
    for (std::size_t at = 0; at < n;) {
        kept.push_back(convex[at]);
        std::size_t next = at + 1;
        const auto passes = [&](std::size_t to) {
            for (std::size_t k = at + 1; k < to; ++k)
                if (distance_to_segment(convex[at], convex[to % n], convex[k]) > kFlat_m) return false;
            return true;
        };
        while (next < n && next - at < kMostSkipped && passes(next + 1)) ++next;
        at = next;
    }
    return kept;
}

/// A hull that is as good as a line gets kThin_m of width.
geo::Polygon with_area(geo::Polygon hull) {
    double area_m2 = 0.0;
    for (std::size_t k = 1; k + 1 < hull.size(); ++k)
        area_m2 += cross(hull[k] - hull.front(), hull[k + 1] - hull.front()) / 2.0;
    if (area_m2 > kThin_m * kThin_m) return hull;
    std::vector<Vec2> points;
    for (const Vec2& p : hull)
        for (const Vec2& corner : {Vec2(-1.0, -1.0), Vec2(1.0, -1.0), Vec2(1.0, 1.0), Vec2(-1.0, 1.0)})
            points.push_back(p + kThin_m * corner);
    return hull_of(std::move(points));
}

/// A convex polygon wider by `width_m`: each corner becomes tangents of its arc.
geo::Polygon widened(const geo::Polygon& convex, double width_m) {
    geo::Polygon wide;
    const std::size_t n = convex.size();
    const auto edge = [&](std::size_t k) { return glm::normalize(convex[(k + 1) % n] - convex[k % n]); };
    for (std::size_t k = 0; k < n; ++k) {
        const Vec2 before = edge(k + n - 1), after = edge(k);
        const double from_rad = std::atan2(-before.x, before.y);  // to the right of the edge: outward
        const double turn_rad = std::max(0.0, std::atan2(cross(before, after), glm::dot(before, after)));
        const double tangents = std::max(1.0, std::ceil(turn_rad / kLongestArc_rad));
        const double step_rad = turn_rad / tangents, reach_m = width_m / std::cos(step_rad / 2.0);
        for (double j = 0.5; j < tangents; j += 1.0) {
            const double angle_rad = from_rad + j * step_rad;
            wide.push_back(convex[k] + reach_m * Vec2(std::cos(angle_rad), std::sin(angle_rad)));
        }
    }
    return wide;
}

double contingency_width_m(const planner::ReportWishes& wishes, double speed_mps) {
    return wishes.volume_gps_m + wishes.volume_path_m + wishes.volume_map_m + speed_mps * wishes.volume_reaction_s +
           speed_mps * speed_mps / (2.0 * kGravity_mps2 * std::tan(radians(wishes.volume_bank_deg)));
}

}  // namespace

FlightVolumes flight_volumes(const OutgoingShow& show, const Run& run) {
    const OutgoingFacts& facts = show.facts();
    const Reach reach = reach_of(show, run);
    FlightVolumes volumes;
    if (reach.over.empty()) return volumes;
    volumes.speed_mps = facts.limits.plane ? facts.limits.plane->airspeed_max_mps : facts.limits.speed_horizontal_mps;
    volumes.contingency_m_wide = contingency_width_m(facts.reporting, volumes.speed_mps);
    volumes.flight_height_m = reach.height_m;
    volumes.contingency_height_m = reach.height_m + volumes.contingency_m_wide;
    volumes.ground_risk_m_wide = std::max(0.0, volumes.contingency_height_m);
    volumes.flight_m = with_area(plain(reach.over));
    volumes.contingency_m = widened(volumes.flight_m, volumes.contingency_m_wide);
    volumes.ground_risk_m = widened(volumes.contingency_m, volumes.ground_risk_m_wide);
    return volumes;
}

}  // namespace aerogram::exporter
