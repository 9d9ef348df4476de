#include "export/waypoint/leg_time.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

constexpr int kHalvings = 60;
constexpr double kStands_m = 1e-6;
constexpr double kLevel = 1e-9;  ///< parts of a direction below this are none

/// The x in [low, high] at which rising(x) passes target.
template <class Rising>
double solve(double low, double high, double target, const Rising& rising) {
    for (int k = 0; k < kHalvings; ++k) {
        const double middle = 0.5 * (low + high);
        (rising(middle) < target ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

/// A gain of speed: the jerk rises for `rise_s`, stays, falls; the acceleration stays at `peak`; all of it backwards.
struct Ramp {
    double peak_mps2 = 0.0, jerk_mps3 = 1.0, rise_s = 0.0, speed_mps = 0.0;

    [[nodiscard]] double bend_s() const { return peak_mps2 / jerk_mps3 + rise_s; }  ///< until the peak is reached
    [[nodiscard]] double duration_s() const { return speed_mps / peak_mps2 + bend_s(); }
    [[nodiscard]] double length_m() const { return 0.5 * speed_mps * duration_s(); }
};

/// Jerk pulses have the sharpness S = J π / (2 rise). Where there is no time for the whole jerk, rises are shorter and
/// the sharpness is kept: jerk 2 S rise / π, peak jerk rise, speed 2 peak rise.
class Ramps {
  public:
    explicit Ramps(const LegModel& model) : model_(model) {
        least_mps2_ = model.jerk_mps3 * kJerkRise_s;
        sharpness_ = 0.5 * model.jerk_mps3 * kPi / kJerkRise_s;
        const double most = model.acceleration_mps2;
        highest_ = most >= least_mps2_ ? Ramp{most, model.jerk_mps3, kJerkRise_s, 0.0}
                                       : with_rise(std::sqrt(0.5 * kPi * most / sharpness_));
    }

    /// The quickest up to a speed.
    [[nodiscard]] Ramp to_speed(double speed_mps) const {
        if (speed_mps >= highest_.peak_mps2 * highest_.bend_s()) return at_peak(speed_mps);
        const auto speed = [](const Ramp& ramp) { return ramp.peak_mps2 * ramp.bend_s(); };
        if (has_whole_jerk(speed, speed_mps)) return whole_jerk(speed, speed_mps);
        return with_rise(std::cbrt(0.25 * kPi * speed_mps / sharpness_));
    }

    /// The one that, with its mirror image, covers a length most quickly.
    [[nodiscard]] Ramp over(double length_m) const {
        const auto length = [](const Ramp& ramp) { return 2.0 * ramp.peak_mps2 * ramp.bend_s() * ramp.bend_s(); };
        if (length_m >= length(highest_)) {
            const double bend_s = highest_.bend_s(), peak = highest_.peak_mps2;
            return at_peak(0.5 * peak * (std::sqrt(bend_s * bend_s + 4.0 * length_m / peak) - bend_s));
        }
        if (has_whole_jerk(length, length_m)) return whole_jerk(length, length_m);
        return with_rise(std::sqrt(std::sqrt(kPi * length_m / (16.0 * sharpness_))));
    }

  private:
    [[nodiscard]] Ramp with_peak(double peak_mps2) const { return {peak_mps2, model_.jerk_mps3, kJerkRise_s, 0.0}; }
    [[nodiscard]] Ramp at_peak(double speed_mps) const {
        Ramp ramp = highest_;
        ramp.speed_mps = speed_mps;
        return ramp;
    }
    [[nodiscard]] Ramp with_rise(double rise_s) const {
        const double jerk = 2.0 * sharpness_ * rise_s / kPi;
        return {jerk * rise_s, jerk, rise_s, 2.0 * jerk * rise_s * rise_s};
    }
    template <class Measure>
    [[nodiscard]] bool has_whole_jerk(const Measure& of, double target) const {
        return model_.acceleration_mps2 >= least_mps2_ && target >= of(with_peak(least_mps2_));
    }
    /// No time at the peak, which is between the least and the highest.
    template <class Measure>
    [[nodiscard]] Ramp whole_jerk(const Measure& of, double target) const {
        Ramp ramp = with_peak(
            solve(least_mps2_, model_.acceleration_mps2, target, [&](double peak) { return of(with_peak(peak)); }));
        ramp.speed_mps = ramp.peak_mps2 * ramp.bend_s();
        return ramp;
    }

    LegModel model_;
    double least_mps2_ = 0.0;  ///< of peaks that see the whole jerk
    double sharpness_ = 1.0;
    Ramp highest_;
};

Vec3 parts(const Vec3& way_m) {
    const double length_m = glm::length(way_m);
    return {std::hypot(way_m.x, way_m.y) / length_m, 0.0, way_m.z / length_m};
}

}  // namespace

LegModel leg_model(const planner::ExportWishes& wishes, const Limits& limits) {
    return {wishes.leg_speed_mps.value_or(limits.speed_horizontal_mps),
            wishes.leg_speed_up_mps.value_or(limits.speed_up_mps),
            wishes.leg_speed_down_mps.value_or(limits.speed_down_mps), wishes.leg_acceleration_mps2,
            wishes.leg_jerk_mps3};
}

double leg_speed_mps(const LegModel& model, const Vec3& way_m) {
    const Vec3 share = parts(way_m);
    double speed_mps = share.x > kLevel ? model.speed_mps / share.x : std::numeric_limits<double>::infinity();
    if (share.z > kLevel) speed_mps = std::min(speed_mps, model.speed_up_mps / share.z);
    if (share.z < -kLevel) speed_mps = std::min(speed_mps, model.speed_down_mps / -share.z);
    return speed_mps;
}

double s_curve_s(const LegModel& model, double speed_mps, double length_m) {
    if (!(length_m > kStands_m)) return 0.0;
    const Ramps ramps(model);
    const Ramp full = ramps.to_speed(speed_mps);
    if (2.0 * full.length_m() <= length_m) return length_m / speed_mps + full.duration_s();
    return 2.0 * ramps.over(length_m).duration_s();
}

double leg_needs_s(const LegModel& model, const Vec3& way_m) {
    const double length_m = glm::length(way_m), waits_s = kShortestHold_s + kMissionSteps_s;
    return length_m > kStands_m ? s_curve_s(model, leg_speed_mps(model, way_m), length_m) + waits_s : waits_s;
}

double takeoff_needs_s(const LegModel& model, double climb_m) {
    return kLiftOff_s + s_curve_s(model, model.speed_up_mps, climb_m) + kMissionSteps_s;
}

double speed_for_s(const LegModel& model, const Vec3& way_m, double duration_s) {
    const double length_m = glm::length(way_m), most_mps = leg_speed_mps(model, way_m);
    if (s_curve_s(model, most_mps, length_m) >= duration_s) return most_mps;
    return solve(0.0, most_mps, -duration_s,
                 [&](double v) { return v > 0.0 ? -s_curve_s(model, v, length_m) : -1e300; });
}

}  // namespace aerogram::exporter
