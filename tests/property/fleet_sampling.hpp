#pragma once
#include <algorithm>
#include <limits>
#include <vector>

#include "geo/units.hpp"
#include "planner/motion/flight_plan.hpp"

/// Oracles that see a plan through sample() alone.
namespace aerogram::property {

inline Points positions_at(const planner::FlightPlan& plan, double t_s) {
    Points now(plan.drones());
    for (std::size_t d = 0; d < now.size(); ++d) now[d] = planner::sample(plan, DroneId(d), t_s).motion.position_m;
    return now;
}

struct Closest {
    double distance_m = std::numeric_limits<double>::infinity();
    std::size_t first = 0, second = 0;
    double time_s = 0.0;
};

inline double distance_at(const planner::FlightPlan& plan, std::size_t first, std::size_t second, double t_s) {
    return SeparationMetric{plan.limits.downwash}.distance(
        planner::sample(plan, DroneId(first), t_s).motion.position_m,
        planner::sample(plan, DroneId(second), t_s).motion.position_m);
}

/// Whether a drone stands on its pad all through a take-off or landing: its neighbours may then be nearer.
inline bool stands_on_pad(const planner::FlightPlan& plan, const planner::Act& act, std::size_t drone) {
    if (act.role != planner::ActRole::takeoff && act.role != planner::ActRole::landing) return false;
    for (int k = 0; k <= 8; ++k) {
        const double t_s = 0.125 * k * seconds_from_ms(act.duration_ms);
        const Vec3 at = planner::kinematics(act, DroneId(drone), t_s).position_m;
        if (glm::distance(at, plan.pads_m[drone]) > 1e-6) return false;
    }
    return true;
}

/// All pairs at every step of an act but those excused, then the closest pair's own minimum around its sample (golden
/// section).
struct SampledSeparation {
    Closest sampled, refined;
};
inline SampledSeparation sampled_separation(const planner::FlightPlan& plan, const planner::Act& act, Millis step_ms) {
    const Millis begin_ms = act.start_ms, end_ms = act.end_ms();
    std::vector<std::size_t> judged;
    for (std::size_t d = 0; d < plan.drones(); ++d)
        if (!stands_on_pad(plan, act, d)) judged.push_back(d);
    const SeparationMetric metric{plan.limits.downwash};
    SampledSeparation found;
    Closest& best = found.sampled;
    for (Millis ms = begin_ms; ms <= end_ms; ms += step_ms) {
        const double t_s = seconds_from_ms(ms);
        const Points now = positions_at(plan, t_s);
        for (std::size_t a = 0; a < judged.size(); ++a) {
            for (std::size_t b = a + 1; b < judged.size(); ++b) {
                const double distance_m = metric.distance(now[judged[a]], now[judged[b]]);
                if (distance_m < best.distance_m) best = {distance_m, judged[a], judged[b], t_s};
            }
        }
    }
    found.refined = best;
    if (judged.size() < 2) return found;
    double low_s = std::max(seconds_from_ms(begin_ms), best.time_s - seconds_from_ms(step_ms));
    double high_s = std::min(seconds_from_ms(end_ms), best.time_s + seconds_from_ms(step_ms));
    for (int halving = 0; halving < 60; ++halving) {
        const double third_s = (high_s - low_s) / 3.0;
        const double left_m = distance_at(plan, best.first, best.second, low_s + third_s);
        const double right_m = distance_at(plan, best.first, best.second, high_s - third_s);
        (left_m < right_m ? high_s : low_s) += left_m < right_m ? -third_s : third_s;
    }
    const double least_m = distance_at(plan, best.first, best.second, 0.5 * (low_s + high_s));
    if (least_m < best.distance_m) found.refined = {least_m, best.first, best.second, 0.5 * (low_s + high_s)};
    return found;
}

}  // namespace aerogram::property
