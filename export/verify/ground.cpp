#include "export/verify/ground.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace aerogram::exporter {
namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();
constexpr int kHalvings = 12;

/// Around a place: what lies in it wherever its control points do, because it is convex.
struct Zone {
    Vec3 place_m{};
    double beside_m = 0.0, above_m = 0.0;

    [[nodiscard]] bool holds(const Vec3& p) const {
        const double x = p.x - place_m.x, y = p.y - place_m.y, z = p.z - place_m.z;
        return z >= -kOnGround_m && z <= above_m && x * x + y * y <= beside_m * beside_m;
    }
    [[nodiscard]] bool holds(std::span<const Vec3> points) const {
        return std::ranges::all_of(points, [this](const Vec3& p) { return holds(p); });
    }
};

/// The largest found u up to which the curve is inside; its beginning is.
double inside_until(const Bezier& curve, const Zone& zone) {
    double inside = 0.0, left = 1.0;
    for (int i = 0; i < kHalvings; ++i) {
        const double u = 0.5 * (inside + left);
        (zone.holds(split(curve, u).first.controls()) ? inside : left) = u;
    }
    return inside;
}

double inside_from(const Bezier& curve, const Zone& zone) {
    double inside_from = 1.0, outside_at = 0.0;
    for (int i = 0; i < kHalvings; ++i) {
        const double u = 0.5 * (inside_from + outside_at);
        (zone.holds(split(curve, u).second.controls()) ? inside_from : outside_at) = u;
    }
    return inside_from;
}

void add(std::vector<Interval>& intervals, const Interval& next) {
    if (!(next.end_s > next.begin_s)) return;
    if (!intervals.empty() && next.begin_s <= intervals.back().end_s) {
        intervals.back().end_s = std::max(intervals.back().end_s, next.end_s);
    } else {
        intervals.push_back(next);
    }
}

/// When the drone is in one zone.
std::vector<Interval> inside(const RecordedDrone& drone, const Zone& zone) {
    std::vector<Interval> found;
    if (zone.holds(first_position(drone))) add(found, {-kForever, drone.pieces.front().start_s});
    for (std::size_t k = 0; k < drone.pieces.size(); ++k) {
        const Piece& piece = drone.pieces[k];
        const std::span<const Vec3> points(&drone.controls_m[piece.first_control], std::size_t{piece.degree} + 1);
        const bool begins = zone.holds(points.front()), ends = zone.holds(points.back());
        if (!begins && !ends) continue;
        const double begin_s = piece.start_s;
        const double finish_s = k + 1 < drone.pieces.size() ? drone.pieces[k + 1].start_s : begin_s + piece.duration_s;
        if (zone.holds(points)) {
            add(found, {begin_s, finish_s});
            continue;
        }
        const Bezier curve = curve_of(drone, piece);
        if (begins) add(found, {begin_s, std::min(finish_s, begin_s + inside_until(curve, zone) * piece.duration_s)});
        if (ends) add(found, {begin_s + inside_from(curve, zone) * piece.duration_s, finish_s});
    }
    if (zone.holds(last_position(drone))) add(found, {end_s(drone), kForever});
    return found;
}

/// At home or at the landing place.
std::vector<Interval> inside_either(const RecordedDrone& drone, double beside_m, double above_m) {
    std::vector<Interval> all;
    const std::optional<Vec3> home = home_place(drone), landing = landing_place(drone);
    if (home) all = inside(drone, {*home, beside_m, above_m});
    if (!landing || landing == home) return all;
    const std::vector<Interval> there = inside(drone, {*landing, beside_m, above_m});
    all.insert(all.end(), there.begin(), there.end());
    std::ranges::sort(all, [](const Interval& a, const Interval& b) {
        return a.begin_s != b.begin_s ? a.begin_s < b.begin_s : a.end_s < b.end_s;
    });
    std::vector<Interval> apart;
    for (const Interval& interval : all) add(apart, interval);
    return apart;
}

/// The ground under a position on it.
std::optional<Vec3> ground_at(const Vec3& p) {
    if (std::abs(p.z) > kOnGround_m) return std::nullopt;
    return Vec3{p.x, p.y, 0.0};
}

}  // namespace

std::optional<Vec3> home_place(const RecordedDrone& drone) {
    return drone.home_m ? drone.home_m : ground_at(first_position(drone));
}

std::optional<Vec3> landing_place(const RecordedDrone& drone) {
    return drone.land_m ? drone.land_m : ground_at(last_position(drone));
}

Places places_of(const RecordedDrone& drone) {
    return {home_place(drone), landing_place(drone)};
}

bool too_close(const Places& a, const Places& b, double least_m) {
    for (const std::optional<Vec3>& p : a) {
        for (const std::optional<Vec3>& q : b) {
            if (p && q && std::hypot(p->x - q->x, p->y - q->y) < least_m) return true;
        }
    }
    return false;
}

std::vector<Interval> grounded_intervals(const RecordedDrone& drone) {
    return inside_either(drone, kOnGround_m, kOnGround_m);
}

std::vector<Interval> upright_intervals(const RecordedDrone& drone, double beside_m) {
    return inside_either(drone, beside_m, kForever);
}

std::vector<Stay> stays(const RecordedDrone& drone, double beside_m) {
    const std::vector<Interval> grounded = grounded_intervals(drone);
    std::vector<Stay> all;
    for (const Interval& g : grounded) all.push_back({g.begin_s, g.end_s, Stance::on_pad});
    for (const Interval& upright : upright_intervals(drone, beside_m)) {
        double from_s = upright.begin_s;
        for (const Interval& g : grounded) {
            if (g.end_s <= from_s || g.begin_s >= upright.end_s) continue;
            if (g.begin_s > from_s) all.push_back({from_s, g.begin_s, Stance::above_pad});
            from_s = g.end_s;
        }
        if (from_s < upright.end_s) all.push_back({from_s, upright.end_s, Stance::above_pad});
    }
    std::ranges::sort(all, {}, &Stay::begin_s);
    return all;
}

}  // namespace aerogram::exporter
