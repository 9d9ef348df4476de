/// Continuous-time separation of one act (certificate.hpp, bound_separation): holds and straight acts, where the
/// difference of two drones is a point or runs along a segment.
#include <algorithm>
#include <cmath>

#include "geo/contract.hpp"
#include "geo/units.hpp"
#include "planner/motion/certificate.hpp"
#include "planner/motion/closest.hpp"
#include "planner/motion/profile.hpp"
#include "planner/motion/swept_tree.hpp"

namespace aerogram::planner {
namespace {

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

void bound_curve(const Hull& d, std::size_t i, std::size_t j, double begin, double end, int depth, Closest& closest) {
    const double share = nearest_share(d[0], d[3]);
    const Vec3 chord = (1.0 - share) * d[0] + share * d[3];
    closest.attained(glm::length(d[0]), i, j, begin);
    closest.attained(glm::length(d[3]), i, j, end);
    const double bound = hull_distance(d, chord);
    if (bound >= closest.enough_m() || depth == 0) {
        closest.not_below(bound);
        return;
    }
    const Halves halves = halved(d);
    const double middle = 0.5 * (begin + end);
    bound_curve(halves.first, i, j, begin, middle, depth - 1, closest);
    bound_curve(halves.second, i, j, middle, end, depth - 1, closest);
}

/// Visitor of a SweptTree without strays: the closest pair of all, exactly. Ties go to the first pair.
class ClosestRun {
  public:
    ClosestRun(std::span<const Vec3> from, std::span<const Vec3> to, double beyond_m, const Run& run)
        : from_(from), to_(to), run_(run), best_m_(beyond_m) {}

    /// A little more than the smallest distance, so that rounding in a node does not hide an equal one.
    [[nodiscard]] double limit_m() const {
        return run_.stopped() ? -std::numeric_limits<double>::infinity() : best_m_ * (1.0 + 1e-12) + 1e-12;
    }
    void visit(std::uint32_t i, std::uint32_t j) {
        const Vec3 w = from_[j] - from_[i], u = to_[j] - to_[i];
        const double share = nearest_share(w, u);
        const double distance_m = glm::length(w + share * (u - w));
        const bool first = i < first_ || (i == first_ && j < second_);
        if (distance_m > best_m_ || (distance_m == best_m_ && found_ && !first)) return;
        best_m_ = distance_m;
        first_ = i;
        second_ = j;
        share_ = share;
        found_ = true;
    }

    [[nodiscard]] bool found() const { return found_; }
    [[nodiscard]] double share() const { return share_; }
    void tell(Closest& closest, double time_share) const {
        if (found_) closest.attained(best_m_, first_, second_, time_share);
    }

  private:
    std::span<const Vec3> from_, to_;
    const Run& run_;
    double best_m_;
    std::uint32_t first_ = 0, second_ = 0;
    double share_ = 0.0;  ///< of the way
    bool found_ = false;
};

Closest bound_straight(std::span<const Vec3> from, std::span<const Vec3> to, const std::vector<double>& profile,
                       double beyond_m, const Run& run) {
    ClosestRun visitor(from, to, beyond_m, run);
    SweptTree(from, to).for_each_close_pair(visitor);
    Closest closest(beyond_m);
    if (visitor.found()) visitor.tell(closest, time_share_at(profile, visitor.share()));
    return closest;
}

Points scaled(const Points& points, std::span<const std::uint32_t> flyers, const SeparationMetric& metric) {
    Points result(flyers.size());
    std::transform(flyers.begin(), flyers.end(), result.begin(),
                   [&](std::uint32_t i) { return metric.scaled(points[i]); });
    return result;
}

}  // namespace

void bound_curve(const Hull& d, std::size_t i, std::size_t j, double begin, double end, Closest& closest) {
    constexpr int kDepth = 40;
    bound_curve(d, i, j, begin, end, kDepth, closest);
}

Closest closest_standing(std::span<const Vec3> points, double beyond_m, double time_share, const Run& run) {
    ClosestRun visitor(points, points, beyond_m, run);
    SweptTree(points, points).for_each_close_pair(visitor);
    Closest closest(beyond_m);
    visitor.tell(closest, time_share);
    return closest;
}

Result<SeparationBound> bound_separation(const Motion& motion, double duration_s, const SeparationMetric& metric,
                                         double beyond_m, const Run& run, std::span<const std::uint8_t> excused) {
    AEROGRAM_REQUIRE(beyond_m > 0.0 && metric.downwash >= 1.0, beyond_m, metric.downwash);
    AEROGRAM_REQUIRE(excused.empty() || excused.size() == drone_count(motion), excused.size());
    std::vector<std::uint32_t> flyers;
    for (std::size_t i = 0; i < drone_count(motion); ++i) {
        if (excused.empty() || excused[i] == 0) flyers.push_back(static_cast<std::uint32_t>(i));
    }
    Closest closest(beyond_m);
    if (flyers.size() < 2) return closest.result(duration_s, flyers);
    if (const auto* straight = std::get_if<Straight>(&motion)) {
        closest = bound_straight(scaled(straight->from_m, flyers, metric), scaled(straight->to_m, flyers, metric),
                                 straight->profile, beyond_m, run);
    } else if (const auto* hold = std::get_if<Hold>(&motion)) {
        closest = closest_standing(scaled(hold->positions_m, flyers, metric), beyond_m, 0.0, run);
    } else {
        auto bound = bound_lattice(std::get<Lattice>(motion), flyers, metric, beyond_m, run);
        if (!bound) return bound.error();
        closest = *bound;
    }
    if (run.stopped()) return stopped_error();
    return closest.result(duration_s, flyers);
}

}  // namespace aerogram::planner
