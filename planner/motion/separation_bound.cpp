/// Continuous-time separation of one act (certificate.hpp, bound_separation).
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geo/contract.hpp"
#include "geo/units.hpp"
#include "planner/motion/certificate.hpp"
#include "planner/motion/neighbours.hpp"

namespace aerogram::planner {
namespace {

/// Distances are resolved to this share of themselves, and never finer than a micrometre.
constexpr double kResolution = 2e-6, kFinest_m = 1e-6;
/// What rounding may have added to a bound: metres, for coordinates up to 100 km.
constexpr double kRounding_m = 1e-9;

using Hull = std::array<Vec3, 4>;  ///< Bézier control points of a pair's difference, in the separation metric

/// Smallest distance so far, and what nothing examined is below.
class Minimum {
  public:
    explicit Minimum(double beyond_m) : beyond_m_(beyond_m), lower_m_(beyond_m) {}

    /// Whatever is certainly not below this need not be looked at more closely.
    [[nodiscard]] double enough_m() const {
        const double attained = std::min(beyond_m_, attained_m_);
        return attained - std::max(kFinest_m, kResolution * attained);
    }
    void attained(double distance_m, std::size_t i, std::size_t j, double time_share) {
        if (distance_m >= attained_m_) return;
        attained_m_ = distance_m;
        first_ = i;
        second_ = j;
        time_share_ = time_share;
    }
    void not_below(double bound_m) { lower_m_ = std::min(lower_m_, bound_m); }

    [[nodiscard]] SeparationBound result(double duration_s) const {
        SeparationBound bound;
        bound.lower_bound_m = std::max(0.0, std::min(lower_m_, attained_m_) - kRounding_m);
        if (std::isfinite(attained_m_)) {
            bound.closest = Encounter{DroneId(first_), DroneId(second_), time_share_ * duration_s, attained_m_};
        }
        return bound;
    }

  private:
    double beyond_m_, lower_m_;
    double attained_m_ = std::numeric_limits<double>::infinity();
    std::size_t first_ = 0, second_ = 0;
    double time_share_ = 0.0;
};

/// Share of [a, b] at which the segment is nearest to the origin.
double nearest_share(const Vec3& a, const Vec3& b) {
    const Vec3 way = b - a;
    const double squared = glm::dot(way, way);
    return squared > 0.0 ? std::clamp(-glm::dot(a, way) / squared, 0.0, 1.0) : 0.0;
}

/// The hull lies beyond the plane through its point of least extent along the chord's nearest direction.
double hull_distance(const Hull& d, const Vec3& towards) {
    const double length = glm::length(towards);
    if (length == 0.0) return 0.0;
    const Vec3 n = towards / length;
    double least = glm::dot(n, d[0]);
    for (std::size_t m = 1; m < 4; ++m) least = std::min(least, glm::dot(n, d[m]));
    return std::max(0.0, least);
}

struct Halves {
    Hull first, second;
};
Halves halved(const Hull& d) {
    const Vec3 a = 0.5 * (d[0] + d[1]), b = 0.5 * (d[1] + d[2]), c = 0.5 * (d[2] + d[3]);
    const Vec3 ab = 0.5 * (a + b), bc = 0.5 * (b + c), middle = 0.5 * (ab + bc);
    return {{d[0], a, ab, middle}, {middle, bc, c, d[3]}};
}

/// One pair on one knot interval, [begin, end] as shares of the act.
void bound_pair(const Hull& d, std::size_t i, std::size_t j, double begin, double end, int depth, Minimum& minimum) {
    const double share = nearest_share(d[0], d[3]);
    const Vec3 chord = (1.0 - share) * d[0] + share * d[3];
    minimum.attained(glm::length(d[0]), i, j, begin);
    minimum.attained(glm::length(d[3]), i, j, end);
    const double bound = hull_distance(d, chord);
    if (bound >= minimum.enough_m() || depth == 0) {
        minimum.not_below(bound);
        return;
    }
    const Halves halves = halved(d);
    const double middle = 0.5 * (begin + end);
    bound_pair(halves.first, i, j, begin, middle, depth - 1, minimum);
    bound_pair(halves.second, i, j, middle, end, depth - 1, minimum);
}

/// Straight synchronised flight: the difference runs along a segment, whatever the profile.
Result<SeparationBound> bound_straight(const Straight& straight, double duration_s, const SeparationMetric& metric,
                                       double beyond_m, const Run& run) {
    Points from(straight.from_m.size()), to(straight.to_m.size());
    std::transform(straight.from_m.begin(), straight.from_m.end(), from.begin(),
                   [&](const Vec3& p) { return metric.scaled(p); });
    std::transform(straight.to_m.begin(), straight.to_m.end(), to.begin(),
                   [&](const Vec3& p) { return metric.scaled(p); });
    double best_squared = beyond_m * beyond_m;
    std::size_t first = 0, second = 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
        if (run.stopped()) return stopped_error();
        for (std::size_t j = i + 1; j < from.size(); ++j) {
            const Vec3 a = from[j] - from[i], way = (to[j] - to[i]) - a;
            const double along = glm::dot(a, way), squared = glm::dot(way, way);
            const double s = along >= 0.0 ? 0.0 : (-along >= squared ? 1.0 : -along / squared);
            const Vec3 nearest = a + s * way;
            const double distance_squared = glm::dot(nearest, nearest);
            if (distance_squared < best_squared) {
                best_squared = distance_squared;
                first = i;
                second = j;
            }
        }
    }
    Minimum minimum(beyond_m);
    if (first != second) {
        const double s = nearest_share(from[second] - from[first], to[second] - to[first]);
        // The instant at which the (monotone) profile has come this far.
        double low = 0.0, high = 1.0;
        const Act unit{"", ActRole::transit, Timing::free,
                       0,  1'000'000,        Straight{{Vec3{}}, {Vec3{1, 0, 0}}, straight.profile}};
        for (int step = 0; step < 60; ++step) {
            const double middle = 0.5 * (low + high);
            (kinematics(unit, DroneId{}, middle * 1000.0).position_m.x < s ? low : high) = middle;
        }
        minimum.attained(std::sqrt(best_squared), first, second, s <= 0.0 ? 0.0 : high);
    }
    return minimum.result(duration_s);
}

void bound_hold(const Hold& hold, const SeparationMetric& metric, double beyond_m, Minimum& minimum) {
    Points scaled(hold.positions_m.size());
    std::transform(hold.positions_m.begin(), hold.positions_m.end(), scaled.begin(),
                   [&](const Vec3& p) { return metric.scaled(p); });
    NeighbourGrid(scaled, beyond_m).for_each_pair([&](std::size_t i, std::size_t j) {
        minimum.attained(glm::length(scaled[j] - scaled[i]), i, j, 0.0);
    });
}

/// One knot interval of a lattice: boxes, grid, then the pairs that may be close.
void bound_interval(const Motion& motion, std::size_t interval, const SeparationMetric& metric, Minimum& minimum,
                    double beyond_m) {
    const std::size_t n = drone_count(motion);
    const auto intervals = static_cast<double>(interval_count(motion));
    std::vector<Hull> curves(n);
    Points centers(n), halves(n);
    double largest = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        curves[i] = bezier(motion, interval, i);
        for (Vec3& p : curves[i]) p = metric.scaled(p);
        Vec3 low = curves[i][0], high = low;
        for (const Vec3& p : curves[i]) {
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        }
        centers[i] = 0.5 * (low + high);
        halves[i] = 0.5 * (high - low);
        largest = std::max({largest, halves[i].x, halves[i].y, halves[i].z});
    }
    const double begin = static_cast<double>(interval) / intervals, end = static_cast<double>(interval + 1) / intervals;
    NeighbourGrid(centers, beyond_m + 2.0 * largest).for_each_pair([&](std::size_t i, std::size_t j) {
        const Vec3 apart = centers[j] - centers[i], reach = halves[i] + halves[j];
        const Vec3 gap{std::max(0.0, std::abs(apart.x) - reach.x), std::max(0.0, std::abs(apart.y) - reach.y),
                       std::max(0.0, std::abs(apart.z) - reach.z)};
        const double boxes = glm::length(gap);
        if (boxes >= minimum.enough_m()) {
            minimum.not_below(boxes);
            return;
        }
        Hull d;
        for (std::size_t m = 0; m < 4; ++m) d[m] = curves[j][m] - curves[i][m];
        bound_pair(d, i, j, begin, end, 40, minimum);
    });
}

}  // namespace

Result<SeparationBound> bound_separation(const Motion& motion, double duration_s, const SeparationMetric& metric,
                                         double beyond_m, const Run& run) {
    AEROGRAM_REQUIRE(beyond_m > 0.0 && metric.downwash >= 1.0, beyond_m, metric.downwash);
    if (const auto* straight = std::get_if<Straight>(&motion))
        return bound_straight(*straight, duration_s, metric, beyond_m, run);
    Minimum minimum(beyond_m);
    if (const auto* hold = std::get_if<Hold>(&motion)) {
        bound_hold(*hold, metric, beyond_m, minimum);
        return minimum.result(duration_s);
    }
    for (std::size_t interval = 0; interval < interval_count(motion); ++interval) {
        if (run.stopped()) return stopped_error();
        bound_interval(motion, interval, metric, minimum, beyond_m);
    }
    return minimum.result(duration_s);
}

}  // namespace aerogram::planner
