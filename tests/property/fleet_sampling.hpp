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

/// All pairs at every step of [begin, end], then the closest pair's own minimum around its sample (golden section).
struct SampledSeparation {
    Closest sampled, refined;
};
inline SampledSeparation sampled_separation(const planner::FlightPlan& plan, Millis begin_ms, Millis end_ms,
                                            Millis step_ms) {
    const SeparationMetric metric{plan.limits.downwash};
    SampledSeparation found;
    Closest& best = found.sampled;
    for (Millis ms = begin_ms; ms <= end_ms; ms += step_ms) {
        const double t_s = seconds_from_ms(ms);
        const Points now = positions_at(plan, t_s);
        for (std::size_t i = 0; i < now.size(); ++i) {
            for (std::size_t j = i + 1; j < now.size(); ++j) {
                const double distance_m = metric.distance(now[i], now[j]);
                if (distance_m < best.distance_m) best = {distance_m, i, j, t_s};
            }
        }
    }
    found.refined = best;
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
