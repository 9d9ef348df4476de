#include "export/verify/ground.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace aerogram::exporter {
namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();
constexpr int kHalvings = 12;

bool stands(const Bezier& curve, const Vec3& place) {
    return std::ranges::all_of(curve.controls(), [&](const Vec3& p) {
        return std::abs(p.z - place.z) <= kOnGround_m && std::hypot(p.x - place.x, p.y - place.y) <= kOnGround_m;
    });
}

/// The largest found u up to which the curve stands; its beginning does.
double standing_until(const Bezier& curve, const Vec3& place) {
    double stood = 0.0, left = 1.0;
    for (int i = 0; i < kHalvings; ++i) {
        const double u = 0.5 * (stood + left);
        (stands(split(curve, u).first, place) ? stood : left) = u;
    }
    return stood;
}

double standing_from(const Bezier& curve, const Vec3& place) {
    double stands_from = 1.0, flies_at = 0.0;
    for (int i = 0; i < kHalvings; ++i) {
        const double u = 0.5 * (stands_from + flies_at);
        (stands(split(curve, u).second, place) ? stands_from : flies_at) = u;
    }
    return stands_from;
}

void add(std::vector<Interval>& intervals, const Interval& next) {
    if (!(next.end_s > next.begin_s)) return;
    if (!intervals.empty() && next.begin_s <= intervals.back().end_s) {
        intervals.back().end_s = std::max(intervals.back().end_s, next.end_s);
    } else {
        intervals.push_back(next);
    }
}

/// When the drone stands at one place.
std::vector<Interval> standing_at(const RecordedDrone& drone, const Vec3& place) {
    std::vector<Interval> found;
    const Vec3 first = first_position(drone), last = last_position(drone);
    if (stands({{first}, 0}, place)) add(found, {-kForever, drone.pieces.front().start_s});
    for (std::size_t k = 0; k < drone.pieces.size(); ++k) {
        const Piece& piece = drone.pieces[k];
        const double begin_s = piece.start_s;
        const double finish_s = k + 1 < drone.pieces.size() ? drone.pieces[k + 1].start_s : begin_s + piece.duration_s;
        const Bezier curve = curve_of(drone, piece);
        if (stands(curve, place)) {
            add(found, {begin_s, finish_s});
            continue;
        }
        if (stands({{curve.front()}, 0}, place)) {
            add(found, {begin_s, std::min(finish_s, begin_s + standing_until(curve, place) * piece.duration_s)});
        }
        if (stands({{curve.back()}, 0}, place)) {
            add(found, {begin_s + standing_from(curve, place) * piece.duration_s, finish_s});
        }
    }
    if (stands({{last}, 0}, place)) add(found, {end_s(drone), kForever});
    return found;
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

std::vector<Interval> grounded_intervals(const RecordedDrone& drone) {
    std::vector<Interval> all;
    for (const std::optional<Vec3>& place : {home_place(drone), landing_place(drone)}) {
        if (!place) continue;
        const std::vector<Interval> there = standing_at(drone, *place);
        all.insert(all.end(), there.begin(), there.end());
    }
    std::ranges::sort(all, [](const Interval& a, const Interval& b) {
        return a.begin_s != b.begin_s ? a.begin_s < b.begin_s : a.end_s < b.end_s;
    });
    std::vector<Interval> apart;
    for (const Interval& interval : all) add(apart, interval);
    return apart;
}

}  // namespace aerogram::exporter
