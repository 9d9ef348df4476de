/// Judging an act against limits and airspace (certificate.hpp, certify).
#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

#include "geo/contract.hpp"
#include "geo/units.hpp"
#include "planner/motion/certificate.hpp"
#include "planner/motion/margin.hpp"
#include "planner/motion/reach.hpp"

namespace aerogram::planner {
namespace {

constexpr double kRelative = 1e-9;  ///< limits are met up to rounding
constexpr double kAltitudeTolerance_m =
    1e-3;  ///< curvature of a straight chord, of no consequence to a vehicle; verify's too
constexpr double kStandsStill_m = 1e-6;

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

using Curve = std::array<Vec3, 4>;

/// Collects one act's certificate.
class Judge {
  public:
    Judge(const Act& act, const Surroundings& around, double asked_separation_m, const Run& run)
        : act_(act),
          around_(around),
          heights_(around.frame),
          reaches_(reaches(act.motion, around.frame, around.pads_m, run)) {
        certificate_.name = act.name;
        certificate_.role = act.role;
        certificate_.start_ms = act.start_ms;
        certificate_.duration_ms = act.duration_ms;
        certificate_.required_separation_m = std::max(planned_separation_m(around.limits), asked_separation_m);
    }

    Status judge_separation(const Run& run) {
        const double required = certificate_.required_separation_m;
        const double beyond = 2.0 * std::max(required, around_.limits.formation_spacing_m);
        auto bound = bound_separation(act_.motion, seconds_from_ms(act_.duration_ms), {around_.limits.downwash}, beyond,
                                      run, excused());
        if (!bound) return bound.error();
        certificate_.separation = *bound;
        if (drone_count(act_.motion) < 2 || keeps(*bound, required)) return Done{};
        const Encounter& e = *bound->closest;
        violated("separation " + number(e.distance_m) + " m of drones " + std::to_string(e.first.number()) + " and " +
                 std::to_string(e.second.number()) + " at " + show_time(e.time_s) + " is below " + number(required) +
                 (required > planned_separation_m(around_.limits) ? " m (arrive.min_separation_m + export_margin_m)"
                                                                  : " m (min_separation_m + export_margin_m)"));
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
    /// below the lowest one by the sagitta of a piece (under a micrometre for pieces of metres). Only the two drones
    /// that go lowest and highest are converted.
    void judge_altitude() {
        const auto& low = reaches_.altitude_low_m;
        const auto& high = reaches_.altitude_high_m;
        if (low.empty()) return;
        judge_low_flight();
        const auto lowest = static_cast<std::size_t>(std::min_element(low.begin(), low.end()) - low.begin());
        const auto highest = static_cast<std::size_t>(std::max_element(high.begin(), high.end()) - high.begin());
        certificate_.altitude_min_m = altitudes(lowest).low_m;
        if (certificate_.altitude_min_m < -kAltitudeTolerance_m) {
            violated("altitude " + number(certificate_.altitude_min_m) + " m of drone " + std::to_string(lowest + 1) +
                     " is below its pad");
        }
        const Altitudes top = altitudes(highest);
        certificate_.altitude_max_m = top.high_m;
        if (top.high_m > around_.limits.ceiling_m + kAltitudeTolerance_m) {
            violated("altitude " + number(top.high_m) + " m of drone " + std::to_string(highest + 1) + " at " +
                     show_time(static_cast<double>(top.highest_interval) * knot_step_s(act_)) +
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

    /// Of one drone, by geodetic conversions.
    struct Altitudes {
        double low_m = std::numeric_limits<double>::infinity(), high_m = -low_m;
        std::size_t highest_interval = 0;
    };
    Altitudes altitudes(std::size_t drone) const {
        Altitudes found;
        for (std::size_t m = 0; m < interval_count(act_.motion); ++m) {
            for (const Vec3& p : bezier(act_.motion, m, drone)) {
                const double altitude_m = around_.frame.altitude_above(around_.pads_m[drone], p);
                found.low_m = std::min(found.low_m, altitude_m);
                if (altitude_m <= found.high_m) continue;
                found.high_m = altitude_m;
                found.highest_interval = m;
            }
        }
        return found;
    }

    /// The first drone that moves sideways too low, and when.
    void judge_low_flight() {
        const double least_m = around_.limits.min_navigation_altitude_m - kAltitudeTolerance_m;
        for (std::size_t i = 0; i < reaches_.low_m.size(); ++i) {
            if (reaches_.altitude_low_m[i] >= least_m + reaches_.error_m) continue;
            if (!reaches_.moves_sideways(i, kStandsStill_m)) continue;
            for (std::size_t m = 0; m < interval_count(act_.motion); ++m) {
                if (low_flight_found(i, m, least_m)) return;
            }
        }
    }
    bool low_flight_found(std::size_t drone, std::size_t interval, double least_m) {
        const Curve curve = bezier(act_.motion, interval, drone);
        const auto stays = [&](const Vec3& p) { return glm::length(Vec2(p) - Vec2(curve[0])) <= kStandsStill_m; };
        if (std::all_of(curve.begin(), curve.end(), stays)) return false;
        const double pad_m = heights_(around_.pads_m[drone]);
        const auto high = [&](const Vec3& p) { return heights_(p) - pad_m >= least_m + reaches_.error_m; };
        if (std::all_of(curve.begin(), curve.end(), high)) return false;
        double low_m = std::numeric_limits<double>::infinity();
        for (const Vec3& p : curve) low_m = std::min(low_m, around_.frame.altitude_above(around_.pads_m[drone], p));
        if (low_m >= least_m) return false;
        violated("drone " + std::to_string(drone + 1) + " moves sideways at " + number(low_m) + " m at " +
                 show_time(static_cast<double>(interval) * knot_step_s(act_)) +
                 ", below min_navigation_altitude_m = " + number(around_.limits.min_navigation_altitude_m));
        return true;
    }

    /// During a take-off or landing in which everybody stays over the own pad: those that stand on it throughout.
    std::vector<std::uint8_t> excused() const {
        if (act_.role != ActRole::takeoff && act_.role != ActRole::landing) return {};
        std::vector<std::uint8_t> standing(around_.pads_m.size());
        for (std::size_t i = 0; i < standing.size(); ++i) {
            const Vec3& pad = around_.pads_m[i];
            if (!reaches_.stays_over(i, pad, kStandsStill_m)) return {};
            standing[i] = std::max(std::abs(reaches_.low_m[i].z - pad.z), std::abs(reaches_.high_m[i].z - pad.z)) <=
                          kStandsStill_m;
        }
        return standing;
    }

    double judge_margin(const std::string& breach, const Margin& margin, const Run& run) {
        const Worst worst = smallest_margin(act_, reaches_, margin, run);
        if (worst.margin_m < 0.0) {
            violated("drone " + std::to_string(worst.drone + 1) + " is " + breach + " by " + number(-worst.margin_m) +
                     " m at " + show_time(worst.time_s));
        }
        return worst.margin_m;
    }

    const Act& act_;
    const Surroundings& around_;
    ActCertificate certificate_;
    Heights heights_;
    Reaches reaches_;
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

Result<ActCertificate> certify(const Act& act, const Surroundings& surroundings, const Run& run,
                               double asked_separation_m) {
    AEROGRAM_REQUIRE(drone_count(act.motion) == surroundings.pads_m.size(), act.name, drone_count(act.motion));
    Judge judge(act, surroundings, asked_separation_m, run);
    if (run.stopped()) return stopped_error();
    if (auto done = judge.judge_separation(run); !done) return done.error();
    judge.judge_dynamics();
    judge.judge_altitude();
    if (run.stopped()) return stopped_error();
    judge.judge_airspace(run);
    if (run.stopped()) return stopped_error();
    return std::move(judge).result();
}

}  // namespace aerogram::planner
