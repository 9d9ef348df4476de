#include "planner/motion/plane_rules.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

#include "geo/units.hpp"

namespace aerogram::planner {
namespace {

constexpr double kRelative = 1e-9;    ///< limits are met up to rounding
constexpr double kResolution = 1e-5;  ///< relative, and absolute below 1
constexpr int kHalvings = 40;
constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// A drone's velocity on a stretch of time: the control points of a quadratic Bézier.
struct Velocity {
    std::array<Vec3, 3> control{};
    double begin_s = 0.0, end_s = 0.0;

    [[nodiscard]] Vec3 first_change() const { return 2.0 / (end_s - begin_s) * (control[1] - control[0]); }
    [[nodiscard]] Vec3 last_change() const { return 2.0 / (end_s - begin_s) * (control[2] - control[1]); }
};

double cross(const Vec3& a, const Vec3& b) {
    return a.x * b.y - a.y * b.x;
}

/// The hull's least extent along its mean direction: no velocity in it is shorter.
double least_length(const std::array<Vec3, 3>& v) {
    const Vec3 mean = v[0] + v[1] + v[2];
    const double length = glm::length(mean);
    if (length <= 0.0) return 0.0;
    const Vec3 n = mean / length;
    return std::max(0.0, std::min({glm::dot(n, v[0]), glm::dot(n, v[1]), glm::dot(n, v[2])}));
}

std::array<Vec3, 3> flattened(std::array<Vec3, 3> v) {
    for (Vec3& p : v) p.z = 0.0;
    return v;
}

double turn_rate(const Vec3& v, const Vec3& a) {
    const double turning = std::abs(cross(v, a)), squared = v.x * v.x + v.y * v.y;
    return squared > 0.0 ? turning / squared : kInfinite;
}

/// Each quantity as something to make small: its value at the start of a stretch, and what it is nowhere below.
struct Airspeed {
    static double at(const Vec3& v, const Vec3&) { return glm::length(v); }
    static double bound(const Velocity& on) { return least_length(on.control); }
};
struct NegativeAirspeed {
    static double at(const Vec3& v, const Vec3&) { return -glm::length(v); }
    static double bound(const Velocity& on) {
        return -std::max({glm::length(on.control[0]), glm::length(on.control[1]), glm::length(on.control[2])});
    }
};
struct NegativeTurnRate {
    static double at(const Vec3& v, const Vec3& a) { return -turn_rate(v, a); }
    /// v × a has these cubic Bernstein coefficients; it is divided by the least |v|² of the hull.
    static double bound(const Velocity& on) {
        const auto& v = on.control;
        const Vec3 a0 = on.first_change(), a1 = on.last_change();
        const double largest =
            std::max({std::abs(cross(v[0], a0)), std::abs(cross(v[0], a1) + 2.0 * cross(v[1], a0)) / 3.0,
                      std::abs(2.0 * cross(v[1], a1) + cross(v[2], a0)) / 3.0, std::abs(cross(v[2], a1))});
        const double least = least_length(flattened(v));
        return least > 0.0 ? -largest / (least * least) : -kInfinite;
    }
};
template <int Sign>
struct NegativeClimb {
    static double at(const Vec3& v, const Vec3&) { return -Sign * v.z; }
    static double bound(const Velocity& on) {
        return -std::max({Sign * on.control[0].z, Sign * on.control[1].z, Sign * on.control[2].z});
    }
};

/// The smallest value of a quantity that was attained, and what none is below.
struct Least {
    double attained = kInfinite, bound = kInfinite;
    std::size_t drone = 0;
    double time_s = 0.0;

    [[nodiscard]] bool settled(double by) const {
        return by >= attained - kResolution * std::max(1.0, std::abs(attained));
    }
    void attain(double value, std::size_t by, double at_s) {
        if (value >= attained) return;
        attained = value;
        drone = by;
        time_s = at_s;
    }
};

template <class Quantity>
void search(const Velocity& on, std::size_t drone, int halvings, Least& least) {
    const double bound = Quantity::bound(on);
    if (!least.settled(bound)) {
        least.attain(Quantity::at(on.control[0], on.first_change()), drone, on.begin_s);
        least.attain(Quantity::at(on.control[2], on.last_change()), drone, on.end_s);
    }
    if (halvings == 0 || least.settled(bound)) {
        least.bound = std::min(least.bound, bound);
        return;
    }
    const auto& v = on.control;
    const Vec3 a = 0.5 * (v[0] + v[1]), b = 0.5 * (v[1] + v[2]), half = 0.5 * (a + b);
    const double middle_s = 0.5 * (on.begin_s + on.end_s);
    search<Quantity>({{v[0], a, half}, on.begin_s, middle_s}, drone, halvings - 1, least);
    search<Quantity>({{half, b, v[2]}, middle_s, on.end_s}, drone, halvings - 1, least);
}

template <class Quantity>
PlaneWorst worst(const Motion& motion, double step_s, double unit) {
    Least least;
    for (std::size_t i = 0; i < drone_count(motion); ++i) {
        for (std::size_t m = 0; m < interval_count(motion); ++m) {
            const Vec3 p1 = control_point(motion, m + 1, i), p2 = control_point(motion, m + 2, i);
            const Vec3 before = (p1 - control_point(motion, m, i)) / step_s, here = (p2 - p1) / step_s,
                       after = (control_point(motion, m + 3, i) - p2) / step_s;
            const double begin_s = static_cast<double>(m) * step_s;
            search<Quantity>({{0.5 * (before + here), here, 0.5 * (here + after)}, begin_s, begin_s + step_s}, i,
                             kHalvings, least);
        }
    }
    return {unit * std::min(least.bound, least.attained), least.drone, least.time_s};
}

}  // namespace

PlaneExtremes plane_extremes(const Motion& motion, double duration_s) {
    const double step_s = duration_s / static_cast<double>(interval_count(motion));
    return {worst<Airspeed>(motion, step_s, 1.0), worst<NegativeAirspeed>(motion, step_s, -1.0),
            worst<NegativeTurnRate>(motion, step_s, -degrees(1.0)), worst<NegativeClimb<1>>(motion, step_s, -1.0),
            worst<NegativeClimb<-1>>(motion, step_s, -1.0)};
}

std::vector<std::string> plane_violations(const PlaneExtremes& found, const PlaneLimits& limits, Millis start_ms) {
    std::vector<std::string> violations;
    const auto judge = [&](const char* limit, const PlaneWorst& worst, double allowed, bool least) {
        const double slack = kRelative * std::max(1.0, allowed);
        if (least ? worst.value >= allowed - slack : worst.value <= allowed + slack) return;
        std::ostringstream text;
        text << limit << ": drone " << worst.drone + 1 << " reaches " << std::setprecision(4) << worst.value << " at "
             << std::fixed << std::setprecision(2) << seconds_from_ms(start_ms) + worst.time_s << " s, limit "
             << std::defaultfloat << std::setprecision(4) << allowed;
        violations.push_back(text.str());
    };
    judge("airspeed_min_mps", found.airspeed_min_mps, limits.airspeed_min_mps, true);
    judge("airspeed_max_mps", found.airspeed_max_mps, limits.airspeed_max_mps, false);
    judge("turn_rate_dps", found.turn_rate_dps, limits.turn_rate_dps, false);
    judge("climb_mps", found.climb_mps, limits.climb_mps, false);
    judge("sink_mps", found.sink_mps, limits.sink_mps, false);
    return violations;
}

}  // namespace aerogram::planner
