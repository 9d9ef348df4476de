#include "planner/motion/reach.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geo/contract.hpp"
#include "geo/vectorized.hpp"
#include "planner/motion/lanes.hpp"

namespace aerogram::planner {
namespace {

constexpr std::size_t kDronesAtOnce = 256;
constexpr double kGoodEnough_m = 2e-5;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// One number a drone, for some drones; the places beyond them repeat the last drone.
using Column = std::array<double, kDronesAtOnce>;
/// One row of control points of these drones.
using Row = std::array<Column, 3>;

/// What has been seen of these drones.
struct Seen {
    Row low, high;
    Column height_low, height_high;

    Seen() {
        for (Column* column : {&low[0], &low[1], &low[2], &height_low}) column->fill(kInfinity);
        for (Column* column : {&high[0], &high[1], &high[2], &height_high}) column->fill(-kInfinity);
    }
};

inline void widen(double* low, double* high, const Lanes& value) {
    Lanes l, h;
    load(low, l);
    load(high, h);
    l = value < l ? value : l;
    h = value > h ? value : h;
    std::memcpy(low, &l, sizeof l);
    std::memcpy(high, &h, sizeof h);
}

inline void take(Seen& seen, std::size_t i, const std::array<double, 3>& form, const Lanes (&p)[3]) {
    for (std::size_t axis = 0; axis < 3; ++axis) widen(&seen.low[axis][i], &seen.high[axis][i], p[axis]);
    const Lanes height = p[2] + p[0] * (form[0] * p[0] + form[1] * p[1]) + form[2] * p[1] * p[1];
    widen(&seen.height_low[i], &seen.height_high[i], height);
}

/// Bézier control points 1 to 3 of one knot interval, and 0 where it is the first.
AEROGRAM_VECTORIZED
void take_interval(const Row& r0, const Row& r1, const Row& r2, const Row& r3, bool first, std::size_t count,
                   const std::array<double, 3>& form, Seen& seen) {
    for (std::size_t i = 0; i < count; i += 4) {
        Lanes begin[3], near[3], far[3], end[3];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            Lanes p0, p1, p2, p3;
            load(&r0[axis][i], p0);
            load(&r1[axis][i], p1);
            load(&r2[axis][i], p2);
            load(&r3[axis][i], p3);
            begin[axis] = (p0 + 4.0 * p1 + p2) / 6.0;
            near[axis] = (2.0 * p1 + p2) / 3.0;
            far[axis] = (p1 + 2.0 * p2) / 3.0;
            end[axis] = (p1 + 4.0 * p2 + p3) / 6.0;
        }
        if (first) take(seen, i, form, begin);
        take(seen, i, form, near);
        take(seen, i, form, far);
        take(seen, i, form, end);
    }
}

/// Drones [first, first + count) of a lattice.
void look_at(const Lattice& lattice, std::size_t first, std::size_t count, const Heights& heights, const Points& pads_m,
             Reaches& into) {
    std::array<Row, 4> rows;
    Seen seen;
    const std::size_t padded = (count + 3) / 4 * 4;
    for (std::size_t k = 0; k < lattice.rows(); ++k) {
        Row& row = rows[k % 4];
        for (std::size_t i = 0; i < padded; ++i) {
            const Vec3& p = lattice.at(k, first + std::min(i, count - 1));
            row[0][i] = p.x;
            row[1][i] = p.y;
            row[2][i] = p.z;
        }
        if (k < 3) continue;
        take_interval(rows[(k - 3) % 4], rows[(k - 2) % 4], rows[(k - 1) % 4], row, k == 3, padded, heights.form(),
                      seen);
    }
    for (std::size_t i = 0; i < count; ++i) {
        const double pad_m = heights(pads_m[first + i]);
        into.low_m[first + i] = {seen.low[0][i], seen.low[1][i], seen.low[2][i]};
        into.high_m[first + i] = {seen.high[0][i], seen.high[1][i], seen.high[2][i]};
        into.altitude_low_m[first + i] = seen.height_low[i] - pad_m;
        into.altitude_high_m[first + i] = seen.height_high[i] - pad_m;
    }
}

/// One drone on a segment: its height is a parabola over the share of the way.
void look_at(std::size_t i, const Vec3& from, const Vec3& to, const Heights& heights, const Vec3& pad_m,
             Reaches& into) {
    const double pad_height_m = heights(pad_m), begin_m = heights(from) - pad_height_m,
                 end_m = heights(to) - pad_height_m;
    const double bend_m = heights.bend_m(to - from);  // coefficient of s²
    double low_m = std::min(begin_m, end_m);
    const double slope_m = end_m - begin_m - bend_m;  // at the start
    if (bend_m > 0.0 && slope_m < 0.0 && -slope_m < 2.0 * bend_m) {
        low_m = begin_m - 0.25 * slope_m * slope_m / bend_m;
    }
    into.low_m[i] = {std::min(from.x, to.x), std::min(from.y, to.y), std::min(from.z, to.z)};
    into.high_m[i] = {std::max(from.x, to.x), std::max(from.y, to.y), std::max(from.z, to.z)};
    into.altitude_low_m[i] = low_m;
    into.altitude_high_m[i] = std::max(begin_m, end_m);
}

double error_m(const Reaches& reaches, const Points& pads_m) {
    double radius_m = 0.0, height_m = 0.0;
    const auto take_point = [&](const Vec3& p) {
        radius_m = std::max(radius_m, glm::length(Vec2(p)));
        height_m = std::max(height_m, std::abs(p.z));
    };
    for (std::size_t i = 0; i < pads_m.size(); ++i) {
        take_point(pads_m[i]);
        take_point(glm::max(glm::abs(reaches.low_m[i]), glm::abs(reaches.high_m[i])));
    }
    return Heights::error_m(radius_m, height_m);
}

/// The same by geodetic conversions, for shows too wide for the form.
void convert_all(const Motion& motion, const geo::ShowFrame& frame, const Points& pads_m, const Run& run,
                 Reaches& into) {
    parallel_for(pads_m.size(), run, "", [&](std::size_t i) {
        into.altitude_low_m[i] = kInfinity;
        into.altitude_high_m[i] = -kInfinity;
        for (std::size_t m = 0; m < interval_count(motion); ++m) {
            for (const Vec3& p : bezier(motion, m, i)) {
                const double altitude_m = frame.altitude_above(pads_m[i], p);
                into.altitude_low_m[i] = std::min(into.altitude_low_m[i], altitude_m);
                into.altitude_high_m[i] = std::max(into.altitude_high_m[i], altitude_m);
            }
        }
    });
    into.error_m = 0.0;
}

}  // namespace

/// Second differences over a kilometre: heights are exact to a nanometre, so the form is to 1e-14 of its size.
Heights::Heights(const geo::ShowFrame& frame) {
    constexpr double kStep_m = 1000.0;
    const double center_m = frame.to_geodetic({}).height_m;
    const auto above_m = [&](double x, double y) { return frame.to_geodetic({x, y, 0.0}).height_m - center_m; };
    const auto both_m = [&](double x, double y) { return 0.5 * (above_m(x, y) + above_m(-x, -y)); };
    xx_ = both_m(kStep_m, 0.0) / (kStep_m * kStep_m);
    yy_ = both_m(0.0, kStep_m) / (kStep_m * kStep_m);
    xy_ = both_m(kStep_m, kStep_m) / (kStep_m * kStep_m) - xx_ - yy_;
}

double Heights::error_m(double radius_m, double height_m) {
    constexpr double kEarth_m = 6.3e6, kFlattening = 0.0034;
    const double tilt = radius_m / kEarth_m;
    return 1e-8 + 1e-7 * radius_m * tilt + 2.0 * radius_m * tilt * tilt * (kFlattening + tilt) + height_m * tilt * tilt;
}

bool Reaches::stays_over(std::size_t i, const Vec3& place_m, double tolerance_m) const {
    const Vec2 below = glm::abs(Vec2(low_m[i] - place_m)), above = glm::abs(Vec2(high_m[i] - place_m));
    return glm::length(glm::max(below, above)) <= tolerance_m;
}

bool Reaches::moves_sideways(std::size_t i, double tolerance_m) const {
    return glm::length(Vec2(high_m[i] - low_m[i])) > tolerance_m;
}

Reaches reaches(const Motion& motion, const geo::ShowFrame& frame, const Points& pads_m, const Run& run) {
    const std::size_t n = pads_m.size();
    AEROGRAM_REQUIRE(drone_count(motion) == n, drone_count(motion), n);
    Reaches result{Points(n), Points(n), std::vector<double>(n), std::vector<double>(n), 0.0};
    const Heights heights(frame);
    if (const auto* lattice = std::get_if<Lattice>(&motion)) {
        parallel_for((n + kDronesAtOnce - 1) / kDronesAtOnce, run, "", [&](std::size_t part) {
            const std::size_t first = part * kDronesAtOnce;
            look_at(*lattice, first, std::min(kDronesAtOnce, n - first), heights, pads_m, result);
        });
    } else {
        const auto* straight = std::get_if<Straight>(&motion);
        const Points& from = straight ? straight->from_m : std::get<Hold>(motion).positions_m;
        const Points& to = straight ? straight->to_m : from;
        for (std::size_t i = 0; i < n; ++i) look_at(i, from[i], to[i], heights, pads_m[i], result);
    }
    if (run.stopped()) return result;
    result.error_m = error_m(result, pads_m);
    if (result.error_m > kGoodEnough_m) convert_all(motion, frame, pads_m, run, result);
    return result;
}

}  // namespace aerogram::planner
