/// Judging an act against limits and airspace (certificate.hpp, certify).
#include <algorithm>
#include <cmath>
#include <functional>
#include <iomanip>
#include <limits>
#include <sstream>

#include "geo/contract.hpp"
#include "geo/units.hpp"
#include "planner/motion/certificate.hpp"

namespace aerogram::planner {
namespace {

constexpr double kRelative = 1e-9;  ///< limits are met up to rounding
constexpr double kAltitudeTolerance_m =
    1e-3;  ///< curvature of a straight chord, of no consequence to a vehicle; verify's too
constexpr double kStandsStill_m = 1e-6;
constexpr double kMarginResolution_m = 1e-3;

/// Four digits; what is below a tenth of a millimetre (or of any unit here) reads 0.
std::string number(double value) {
    std::ostringstream text;
    text << std::setprecision(4) << (std::abs(value) < 1e-4 ? 0.0 : value);
    return text.str();
}

std::string seconds(double t_s) {
    std::ostringstream text;
    text << std::fixed << std::setprecision(2) << t_s << " s";
    return text.str();
}

/// Where a margin is smallest.
struct Worst {
    double margin_m = std::numeric_limits<double>::infinity();
    std::size_t drone = 0;
    double time_s = 0.0;
};

using Curve = std::array<Vec3, 4>;

/// A distance to keep, 1-Lipschitz in its place; upright ones do not depend on height.
struct Margin {
    std::function<double(const Vec3&)> at;
    bool upright = false;

    [[nodiscard]] double radius_m(const Vec3& offset) const {
        return upright ? glm::length(Vec2(offset)) : glm::length(offset);
    }
};

/// Margins are found to a millimetre near zero and to a thousandth elsewhere.
double resolution_m(double margin_m) {
    return std::max(kMarginResolution_m, 1e-3 * margin_m);
}

/// Smallest value of a 1-Lipschitz margin along a Bézier curve: the middle of the hull, less the hull's radius; halves
/// while that is not yet within the resolution of the smallest value seen.
void search_margin(const Curve& d, double begin_s, double end_s, std::size_t drone, int depth, const Margin& margin,
                   Worst& worst, double& lower_m) {
    Vec3 middle{};
    for (const Vec3& p : d) middle += 0.25 * p;
    double radius = 0.0;
    for (const Vec3& p : d) radius = std::max(radius, margin.radius_m(p - middle));
    const double at_middle = margin.at(middle);
    if (at_middle - radius >= worst.margin_m - resolution_m(worst.margin_m)) {
        lower_m = std::min(lower_m, at_middle - radius);
        return;
    }
    const double at_start = margin.at(d[0]);
    if (at_start < worst.margin_m) worst = {at_start, drone, begin_s};
    const double at_end = margin.at(d[3]);
    if (at_end < worst.margin_m) worst = {at_end, drone, end_s};
    if (radius <= resolution_m(at_middle) || depth == 0) {
        lower_m = std::min(lower_m, at_middle - radius);
        return;
    }
    const Vec3 a = 0.5 * (d[0] + d[1]), b = 0.5 * (d[1] + d[2]), c = 0.5 * (d[2] + d[3]);
    const Vec3 ab = 0.5 * (a + b), bc = 0.5 * (b + c), half = 0.5 * (ab + bc);
    const double half_s = 0.5 * (begin_s + end_s);
    search_margin({d[0], a, ab, half}, begin_s, half_s, drone, depth - 1, margin, worst, lower_m);
    search_margin({half, bc, c, d[3]}, half_s, end_s, drone, depth - 1, margin, worst, lower_m);
}

/// The smallest margin found; an unfinished search (a stop was asked for) is thrown away by the caller.
Worst smallest_margin(const Act& act, const Margin& margin, const Run& run) {
    Worst worst;
    double lower_m = std::numeric_limits<double>::infinity();
    const double step_s = knot_step_s(act);
    for (std::size_t i = 0; i < drone_count(act.motion) && !run.stopped(); ++i) {
        for (std::size_t m = 0; m < interval_count(act.motion); ++m) {
            const double begin_s = static_cast<double>(m) * step_s;
            search_margin(bezier(act.motion, m, i), begin_s, begin_s + step_s, i, 40, margin, worst, lower_m);
        }
    }
    worst.margin_m = std::min(worst.margin_m, lower_m);  // never more than what was proved
    return worst;
}

/// Collects one act's certificate.
class Judge {
  public:
    Judge(const Act& act, const Surroundings& around) : act_(act), around_(around) {
        certificate_.name = act.name;
        certificate_.role = act.role;
        certificate_.start_ms = act.start_ms;
        certificate_.duration_ms = act.duration_ms;
        certificate_.required_separation_m = planned_separation_m(around.limits);
    }

    Status judge_separation(const Run& run) {
        const double required = certificate_.required_separation_m;
        const double beyond = 2.0 * std::max(required, around_.limits.formation_spacing_m);
        auto bound =
            bound_separation(act_.motion, seconds_from_ms(act_.duration_ms), {around_.limits.downwash}, beyond, run);
        if (!bound) return bound.error();
        certificate_.separation = *bound;
        if (drone_count(act_.motion) < 2 || keeps(*bound, required)) return Done{};
        const Encounter& e = *bound->closest;
        violated("separation " + number(e.distance_m) + " m of drones " + std::to_string(e.first.number()) + " and " +
                 std::to_string(e.second.number()) + " at " + show_time(e.time_s) + " is below " + number(required) +
                 " m (min_separation_m + export_margin_m)");
        return Done{};
    }

    void judge_dynamics() {
        const Limits& l = around_.limits;
        const Extremes e = extremes(act_.motion, seconds_from_ms(act_.duration_ms));
        certificate_.extremes = e;
        if (l.plane) {
            certificate_.plane = plane_extremes(act_.motion, seconds_from_ms(act_.duration_ms));
            for (const std::string& v : plane_violations(*certificate_.plane, *l.plane, act_.start_ms)) violated(v);
        } else {
            not_above("speed_horizontal_mps", e.speed_horizontal_mps, l.speed_horizontal_mps);
            not_above("speed_up_mps", e.speed_up_mps, l.speed_up_mps);
            not_above("speed_down_mps", e.speed_down_mps, l.speed_down_mps);
        }
        not_above("acceleration_mps2", e.acceleration_mps2, l.acceleration_mps2);
        not_above("jerk_mps3", e.jerk_mps3, l.jerk_mps3);
    }

    /// Altitude is convex in position, so its maximum over a Bézier hull is at a control point; its minimum may be
    /// below the lowest one by the sagitta of a piece (under a micrometre for pieces of metres).
    void judge_altitude() {
        double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
        std::size_t highest_drone = 0, highest_interval = 0;
        for (std::size_t i = 0; i < drone_count(act_.motion); ++i) {
            for (std::size_t m = 0; m < interval_count(act_.motion); ++m) {
                const Curve curve = bezier(act_.motion, m, i);
                double low_m = std::numeric_limits<double>::infinity();
                for (const Vec3& p : curve) {
                    const double altitude_m = around_.frame.altitude_above(around_.pads_m[i], p);
                    low_m = std::min(low_m, altitude_m);
                    if (altitude_m <= highest) continue;
                    highest = altitude_m;
                    highest_drone = i;
                    highest_interval = m;
                }
                lowest = std::min(lowest, low_m);
                judge_low_flight(i, m, curve, low_m);
            }
        }
        certificate_.altitude_min_m = lowest;
        certificate_.altitude_max_m = highest;
        if (highest > around_.limits.ceiling_m + kAltitudeTolerance_m) {
            violated("altitude " + number(highest) + " m of drone " + std::to_string(highest_drone + 1) + " at " +
                     show_time(static_cast<double>(highest_interval) * knot_step_s(act_)) +
                     " is above ceiling_m = " + number(around_.limits.ceiling_m));
        }
    }

    void judge_airspace(const Run& run) {
        const geo::Airspace& air = around_.airspace;
        if (!air.geofence_m.empty()) {
            const auto inside = [&](const Vec3& p) { return geo::signed_distance(air.geofence_m, Vec2(p)); };
            certificate_.geofence_margin_m = judge_margin("outside the geofence", {inside, true}, run);
        }
        for (const geo::Polygon& polygon : air.audience_m) {
            const auto outside = [&](const Vec3& p) { return -geo::signed_distance(polygon, Vec2(p)); };
            take_smaller(certificate_.audience_margin_m, judge_margin("over the audience", {outside, true}, run));
        }
        for (const geo::Obstacle& obstacle : air.obstacles) {
            const auto clear = [&](const Vec3& p) { return geo::clearance(obstacle, p); };
            take_smaller(certificate_.obstacle_margin_m,
                         judge_margin("inside obstacle " + obstacle.name, {clear, false}, run));
        }
    }

    ActCertificate result() && { return std::move(certificate_); }

  private:
    std::string show_time(double local_s) const { return seconds(seconds_from_ms(act_.start_ms) + local_s); }
    void violated(const std::string& what) { certificate_.violations.push_back(act_.name + ": " + what); }
    static void take_smaller(std::optional<double>& kept, double margin_m) {
        kept = std::min(kept.value_or(margin_m), margin_m);
    }

    void not_above(const char* limit, double value, double most) {
        if (value > most * (1.0 + kRelative))
            violated(std::string(limit) + ": reaches " + number(value) + ", limit " + number(most));
    }

    void judge_low_flight(std::size_t drone, std::size_t interval, const Curve& curve, double low_m) {
        if (low_m >= around_.limits.min_navigation_altitude_m - kAltitudeTolerance_m || low_flight_found_) return;
        for (const Vec3& p : curve) {
            if (glm::length(Vec2(p) - Vec2(curve[0])) <= kStandsStill_m) continue;
            low_flight_found_ = true;
            violated("drone " + std::to_string(drone + 1) + " moves sideways at " + number(low_m) + " m at " +
                     show_time(static_cast<double>(interval) * knot_step_s(act_)) +
                     ", below min_navigation_altitude_m = " + number(around_.limits.min_navigation_altitude_m));
            return;
        }
    }

    double judge_margin(const std::string& breach, const Margin& margin, const Run& run) {
        const Worst worst = smallest_margin(act_, margin, run);
        if (worst.margin_m < 0.0) {
            violated("drone " + std::to_string(worst.drone + 1) + " is " + breach + " by " + number(-worst.margin_m) +
                     " m at " + show_time(worst.time_s));
        }
        return worst.margin_m;
    }

    const Act& act_;
    const Surroundings& around_;
    ActCertificate certificate_;
    bool low_flight_found_ = false;
};

}  // namespace

bool Certificate::certified() const {
    return violations.empty() &&
           std::all_of(acts.begin(), acts.end(), [](const ActCertificate& act) { return act.certified(); });
}

double Certificate::min_separation_m() const {
    double least = std::numeric_limits<double>::infinity();
    for (const ActCertificate& act : acts) least = std::min(least, act.separation.lower_bound_m);
    return least;
}

Result<ActCertificate> certify(const Act& act, const Surroundings& surroundings, const Run& run) {
    AEROGRAM_REQUIRE(drone_count(act.motion) == surroundings.pads_m.size(), act.name, drone_count(act.motion));
    Judge judge(act, surroundings);
    if (auto done = judge.judge_separation(run); !done) return done.error();
    judge.judge_dynamics();
    judge.judge_altitude();
    if (run.stopped()) return stopped_error();
    judge.judge_airspace(run);
    if (run.stopped()) return stopped_error();
    return std::move(judge).result();
}

}  // namespace aerogram::planner
