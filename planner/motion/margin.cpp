#include "planner/motion/margin.hpp"

#include <algorithm>
#include <cmath>

#include "geo/units.hpp"
#include "planner/motion/profile.hpp"

namespace aerogram::planner {
namespace {

using Curve = std::array<Vec3, 4>;

double resolution_m(double margin_m) {
    constexpr double kResolution_m = 1e-3, kShare = 1e-3;
    return std::max(kResolution_m, kShare * margin_m);
}

/// Branch and bound: whatever lies within a radius of a place has a margin of at least the place's less the radius.
class MarginSearch {
  public:
    MarginSearch(const Motion& motion, const Margin& margin) : motion_(motion), margin_(margin) {}

    /// Nothing down to this margin needs a closer look.
    [[nodiscard]] bool enough(double margin_m) const {
        return margin_m >= worst_.margin_m - resolution_m(worst_.margin_m);
    }
    void not_below(double margin_m) { lower_m_ = std::min(lower_m_, margin_m); }
    /// One drone's whole act; places in time are shares of it (of the way, where the act is straight).
    void search(std::size_t drone) {
        drone_ = drone;
        if (const auto* lattice = std::get_if<Lattice>(&motion_))
            return search_intervals(*lattice, 0, interval_count(motion_));
        const auto* straight = std::get_if<Straight>(&motion_);
        const Vec3& from = straight ? straight->from_m[drone] : std::get<Hold>(motion_).positions_m[drone];
        const Vec3& to = straight ? straight->to_m[drone] : from;
        search_curve({from, from + (to - from) / 3.0, to - (to - from) / 3.0, to}, 0.0, 1.0, kDepth);
    }
    [[nodiscard]] Worst result() const {
        Worst worst = worst_;
        worst.margin_m = std::min(worst.margin_m, lower_m_);  // never more than what was proved
        return worst;
    }

  private:
    static constexpr int kDepth = 40;

    /// Knot intervals [begin, end): the box of their control points, then halves, then single curves.
    void search_intervals(const Lattice& lattice, std::size_t begin, std::size_t end) {
        const auto share = [&](std::size_t m) {
            return static_cast<double>(m) / static_cast<double>(lattice.rows() - 3);
        };
        if (end - begin == 1) return search_curve(bezier(motion_, begin, drone_), share(begin), share(end), kDepth);
        Vec3 low = lattice.at(begin, drone_), high = low;
        for (std::size_t k = begin + 1; k < end + 3; ++k) {
            low = glm::min(low, lattice.at(k, drone_));
            high = glm::max(high, lattice.at(k, drone_));
        }
        const double bound_m = margin_.at(0.5 * (low + high)) - margin_.radius_m(0.5 * (high - low));
        if (enough(bound_m)) return not_below(bound_m);
        const std::size_t middle = (begin + end) / 2;
        search_intervals(lattice, begin, middle);
        search_intervals(lattice, middle, end);
    }

    void search_curve(const Curve& d, double begin, double end, int depth) {
        Vec3 middle{};
        for (const Vec3& p : d) middle += 0.25 * p;
        double radius = 0.0;
        for (const Vec3& p : d) radius = std::max(radius, margin_.radius_m(p - middle));
        const double at_middle = margin_.at(middle);
        if (enough(at_middle - radius)) return not_below(at_middle - radius);
        attained(margin_.at(d[0]), begin);
        attained(margin_.at(d[3]), end);
        if (radius <= resolution_m(at_middle) || depth == 0) return not_below(at_middle - radius);
        const Vec3 a = 0.5 * (d[0] + d[1]), b = 0.5 * (d[1] + d[2]), c = 0.5 * (d[2] + d[3]);
        const Vec3 ab = 0.5 * (a + b), bc = 0.5 * (b + c), half = 0.5 * (ab + bc);
        const double half_time = 0.5 * (begin + end);
        search_curve({d[0], a, ab, half}, begin, half_time, depth - 1);
        search_curve({half, bc, c, d[3]}, half_time, end, depth - 1);
    }
    void attained(double margin_m, double time_share) {
        if (margin_m < worst_.margin_m) worst_ = {margin_m, drone_, time_share};
    }

    const Motion& motion_;
    const Margin& margin_;
    Worst worst_;  ///< time_s is a share here
    double lower_m_ = std::numeric_limits<double>::infinity();
    std::size_t drone_ = 0;
};

}  // namespace

Worst smallest_margin(const Act& act, const Reaches& reaches, const Margin& margin, const Run& run) {
    const std::size_t n = reaches.low_m.size();
    if (n == 0) return {};
    std::vector<double> bounds(n);
    for (std::size_t i = 0; i < n; ++i) {
        const Vec3 half = 0.5 * (reaches.high_m[i] - reaches.low_m[i]);
        bounds[i] = margin.at(reaches.low_m[i] + half) - margin.radius_m(half);
    }
    MarginSearch search(act.motion, margin);
    const auto least = static_cast<std::size_t>(std::min_element(bounds.begin(), bounds.end()) - bounds.begin());
    search.search(least);
    std::vector<std::size_t> near;  // the others that may be as low, lowest first
    for (std::size_t i = 0; i < n; ++i) {
        if (i != least && !search.enough(bounds[i])) near.push_back(i);
        if (i != least && search.enough(bounds[i])) search.not_below(bounds[i]);
    }
    std::sort(near.begin(), near.end(),
              [&](std::size_t a, std::size_t b) { return bounds[a] != bounds[b] ? bounds[a] < bounds[b] : a < b; });
    for (const std::size_t i : near) {
        if (run.stopped()) break;
        search.enough(bounds[i]) ? search.not_below(bounds[i]) : search.search(i);
    }
    Worst worst = search.result();
    if (const auto* straight = std::get_if<Straight>(&act.motion)) {
        worst.time_s = time_share_at(straight->profile, worst.time_s);
    }
    worst.time_s *= seconds_from_ms(act.duration_ms);
    return worst;
}

}  // namespace aerogram::planner
