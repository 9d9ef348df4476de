/// Where a carrier is at each instant (ride.hpp, CarrierMotion).
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "planner/carrier/ride.hpp"

namespace aerogram::planner {
namespace {

constexpr double kShare = 0.5;  ///< of acceleration and jerk limits, for gathering speed
constexpr double kReach_m = 1e-6;

/// Speed rises as u²(3 - 2u): its largest slope is 3/2, its largest bend 6.
double ramp_s(double speed_mps, const Limits& limits) {
    return std::max(1.5 * speed_mps / (kShare * limits.acceleration_mps2),
                    std::sqrt(6.0 * speed_mps / (kShare * limits.jerk_mps3)));
}

/// The largest speed that is reached in a given time.
double speed_after(double ramp_s, const Limits& limits) {
    return kShare * std::min(limits.acceleration_mps2 * ramp_s / 1.5, limits.jerk_mps3 * ramp_s * ramp_s / 6.0);
}

/// Share of speed times ramp that is flown until share u of the ramp.
double ramped(double u) {
    return u * u * u * (1.0 - 0.5 * u);
}

}  // namespace

Result<CarrierMotion> CarrierMotion::of(const Mission& mission, double duration_s) {
    auto path = CarrierPath::through(mission);
    if (!path) return path.error();
    const Carrier& carrier = *mission.carrier;
    CarrierMotion motion(std::move(*path), carrier);
    motion.duration_s_ = duration_s;
    motion.speed_mps_ = carrier.speed_mps;
    if (mission.fleet.vehicle != Vehicle::plane) {
        motion.ramp_s_ = std::min(ramp_s(carrier.speed_mps, mission.limits), 0.5 * duration_s);
        motion.speed_mps_ = std::min(carrier.speed_mps, speed_after(motion.ramp_s_, mission.limits));
    }
    const double needed_m = motion.speed_mps_ * (duration_s - motion.ramp_s_);
    const double length_m = motion.path_.length_m();
    if (needed_m <= length_m + kReach_m) return motion;
    std::ostringstream text;
    text << std::fixed << std::setprecision(1) << "carrier.waypoints_m: the route is " << length_m
         << " m long with its corners rounded; the show rides " << duration_s << " s on it and needs " << needed_m
         << " m at " << std::defaultfloat << std::setprecision(6) << carrier.speed_mps << " m/s";
    return Error{ErrorCode::infeasible, mission.at(carrier.line, text.str())};
}

double CarrierMotion::way_m(double t_s) const {
    const double t = std::clamp(t_s, 0.0, duration_s_), left_s = duration_s_ - t;
    const double all_m = speed_mps_ * (duration_s_ - ramp_s_);
    if (t < ramp_s_) return speed_mps_ * ramp_s_ * ramped(t / ramp_s_);
    if (left_s < ramp_s_) return all_m - speed_mps_ * ramp_s_ * ramped(left_s / ramp_s_);
    return speed_mps_ * (t - 0.5 * ramp_s_);
}

Vec3 CarrierMotion::at(double t_s) const {
    return path_.at(way_m(t_s));
}

double CarrierMotion::turned_rad(double t_s) const {
    return turns_ ? path_.yaw_rad(way_m(t_s)) - path_.yaw_rad(0.0) : 0.0;
}

Vec3 CarrierMotion::carried(const Vec3& placed_m, double t_s) const {
    const Vec3 d = placed_m - path_.at(0.0);
    const double turned = turned_rad(t_s), c = std::cos(turned), s = std::sin(turned);
    return at(t_s) + Vec3{c * d.x - s * d.y, s * d.x + c * d.y, d.z};
}

}  // namespace aerogram::planner
