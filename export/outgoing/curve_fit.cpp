#include "export/outgoing/curve_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

using planner::Act, planner::Kinematics;
using Cubic = std::array<Vec3, 4>;

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kStill_m = 1e-9;  ///< a drone whose control points stay this close stands

Vec3 blossom(const Cubic& c, double a, double b, double d) {
    const auto lerp = [](const Vec3& p, const Vec3& q, double t) { return p + t * (q - p); };
    const Vec3 p0 = lerp(c[0], c[1], a), p1 = lerp(c[1], c[2], a), p2 = lerp(c[2], c[3], a);
    return lerp(lerp(p0, p1, b), lerp(p1, p2, b), d);
}

/// The part of a cubic between parameters a and b, as a cubic of its own.
Cubic part(const Cubic& c, double a, double b) {
    return {blossom(c, a, a, a), blossom(c, a, a, b), blossom(c, a, b, b), blossom(c, b, b, b)};
}

Cubic hermite(const Act& act, DroneId drone, double from_s, double to_s) {
    const Kinematics a = planner::kinematics(act, drone, from_s), b = planner::kinematics(act, drone, to_s);
    const double third_s = (to_s - from_s) / 3.0;
    return {a.position_m, a.position_m + third_s * a.velocity_mps, b.position_m - third_s * b.velocity_mps,
            b.position_m};
}

/// Acceleration is linear on a cubic: largest at an end.
double largest_acceleration(const Cubic& c, double duration_s) {
    const double factor = 6.0 / (duration_s * duration_s);
    return factor * std::max(glm::length(c[0] - 2.0 * c[1] + c[2]), glm::length(c[1] - 2.0 * c[2] + c[3]));
}

bool stands(const planner::Motion& motion, DroneId drone) {
    if (std::holds_alternative<planner::Hold>(motion)) return true;
    const Vec3 first = planner::control_point(motion, 0, drone.value);
    for (std::size_t row = 1; row < planner::interval_count(motion) + 3; ++row)
        if (glm::length(planner::control_point(motion, row, drone.value) - first) > kStill_m) return false;
    return true;
}

/// Bounds the difference of the act and its fit on one stretch where each is a single cubic.
void widen(double& position_m, double& speed_mps, const Cubic& exact, const Cubic& fit, double duration_s) {
    Cubic difference;
    for (std::size_t i = 0; i < 4; ++i) difference[i] = fit[i] - exact[i];
    for (const Vec3& d : difference) position_m = std::max(position_m, glm::length(d));
    for (std::size_t i = 0; i < 3; ++i)
        speed_mps = std::max(speed_mps, 3.0 * glm::length(difference[i + 1] - difference[i]) / duration_s);
}

std::vector<Millis> boundaries(Millis duration_ms, Millis pieces) {
    std::vector<Millis> bounds;
    for (Millis j = 0; j <= pieces; ++j) bounds.push_back((2 * j * duration_ms + pieces) / (2 * pieces));
    return bounds;
}

std::vector<std::vector<Millis>> all_choices(const Act& act) {
    const Millis most = std::max<Millis>(1, act.duration_ms / kShortestPieceMs);
    std::vector<Millis> counts{most};
    for (Millis n = 1; n < most; n *= 2) {
        counts.push_back(n);
        if (n > 1 && n + n / 2 < most) counts.push_back(n + n / 2);
    }
    const Millis knots = static_cast<Millis>(planner::interval_count(act.motion));
    if (knots < most) counts.push_back(knots);
    std::ranges::sort(counts);
    counts.erase(std::unique(counts.begin(), counts.end()), counts.end());
    std::vector<std::vector<Millis>> choices;
    for (const Millis n : counts) choices.push_back(boundaries(act.duration_ms, n));
    return choices;
}

/// The same act flown by one drone over one metre.
Act unit_flight(const Act& act, const planner::Straight& straight) {
    Act unit{act.name, act.role, act.timing, 0, act.duration_ms, {}};
    unit.motion = planner::Straight{{Vec3{}}, {Vec3{1.0, 0.0, 0.0}}, straight.profile};
    return unit;
}

}  // namespace

FitError fit_bound(const Limits& limits) {
    const double millimetres_m = std::sqrt(3.0) * 0.001;  // two points, each rounded by half
    const double position_m = std::min(kFitPosition_m, (limits.export_margin_m - millimetres_m) / 2.0);
    return {position_m, kFitSpeed_mps, kFitAccelerationShare * limits.acceleration_mps2};
}

FitError fit_aim(const Limits& limits) {
    const FitError bound = fit_bound(limits);
    return {std::min(0.004, bound.position_m), 0.02, std::min(0.03, bound.acceleration_mps2)};
}

ActFitter::ActFitter(const Act& act, const Limits& limits)
    : act_(act), aim_(fit_aim(limits)), acceleration_limit_mps2_(limits.acceleration_mps2), choices_(all_choices(act)) {
    const auto* straight = std::get_if<planner::Straight>(&act.motion);
    if (straight == nullptr) return;
    const Act unit = unit_flight(act, *straight);
    const Exact exact = exact_curve(unit, DroneId(0));
    for (const auto& bounds : choices_) unit_misfits_.push_back(measured(unit, DroneId(0), exact, bounds, kNever));
}

ActFitter::Exact ActFitter::exact_curve(const Act& act, DroneId drone) {
    Exact exact;
    const std::size_t intervals = planner::interval_count(act.motion);
    const double h = planner::knot_step_s(act);
    exact.cubics.reserve(intervals);
    for (std::size_t m = 0; m < intervals; ++m) {
        exact.cubics.push_back(planner::bezier(act.motion, m, drone.value));
        exact.peak_mps2 = std::max(exact.peak_mps2, largest_acceleration(exact.cubics.back(), h));
    }
    return exact;
}

ActFitter::Misfit ActFitter::measured(const Act& act, DroneId drone, const Exact& exact,
                                      const std::vector<Millis>& bounds, double give_up_m) {
    Misfit result;
    result.exact_peak_mps2 = exact.peak_mps2;
    const std::size_t intervals = exact.cubics.size();
    const double h = planner::knot_step_s(act);
    std::size_t m = 0;
    for (std::size_t j = 0; j + 1 < bounds.size() && result.position_m <= give_up_m; ++j) {
        const double from_s = seconds_from_ms(bounds[j]), to_s = seconds_from_ms(bounds[j + 1]),
                     length_s = to_s - from_s;
        const Cubic fit = hermite(act, drone, from_s, to_s);
        result.fit_peak_mps2 = std::max(result.fit_peak_mps2, largest_acceleration(fit, length_s));
        for (double at_s = from_s; at_s < to_s; ++m) {
            const double knot_s = static_cast<double>(m) * h;
            const bool last = m + 1 == intervals || static_cast<double>(m + 1) * h >= to_s;
            const double end_s = last ? to_s : static_cast<double>(m + 1) * h;
            if (end_s - at_s > 1e-9)
                widen(result.position_m, result.speed_mps,
                      part(exact.cubics[m], (at_s - knot_s) / h, (end_s - knot_s) / h),
                      part(fit, (at_s - from_s) / length_s, (end_s - from_s) / length_s), end_s - at_s);
            at_s = end_s;
            if (last) break;
        }
    }
    return result;
}

FitError ActFitter::error_of(const Misfit& m) const {
    const double allowed_mps2 = std::max(m.exact_peak_mps2, acceleration_limit_mps2_);
    return {m.position_m, m.speed_mps, std::max(0.0, m.fit_peak_mps2 - allowed_mps2)};
}

FitError ActFitter::error_of(DroneId drone, const Exact& exact, std::size_t choice) const {
    const double give_up_m = choice + 1 < choices_.size() ? aim_.position_m : kNever;
    if (unit_misfits_.empty()) return error_of(measured(act_, drone, exact, choices_[choice], give_up_m));
    const auto& straight = std::get<planner::Straight>(act_.motion);
    const double l = glm::length(straight.to_m[drone.value] - straight.from_m[drone.value]);
    const Misfit& unit = unit_misfits_[choice];
    return error_of(Misfit{l * unit.position_m, l * unit.speed_mps, l * unit.exact_peak_mps2, l * unit.fit_peak_mps2});
}

Fitted ActFitter::fit(DroneId drone) const {
    Fitted result;
    if (stands(act_.motion, drone)) {
        const Vec3 place = planner::control_point(act_.motion, 0, drone.value);
        result.pieces.push_back({act_.start_ms, act_.duration_ms, true, {place, place, place, place}});
        return result;
    }
    const Exact exact = unit_misfits_.empty() ? exact_curve(act_, drone) : Exact{};
    std::size_t choice = 0;
    result.error = error_of(drone, exact, choice);
    while (!result.error.within(aim_) && choice + 1 < choices_.size()) result.error = error_of(drone, exact, ++choice);
    const std::vector<Millis>& bounds = choices_[choice];
    for (std::size_t j = 0; j + 1 < bounds.size(); ++j)
        result.pieces.push_back({act_.start_ms + bounds[j], bounds[j + 1] - bounds[j], false,
                                 hermite(act_, drone, seconds_from_ms(bounds[j]), seconds_from_ms(bounds[j + 1]))});
    return result;
}

}  // namespace aerogram::exporter
