/// The mission as it is planned before the ride (ride.hpp, placed_at_start).
#include <algorithm>
#include <cmath>

#include "geo/contract.hpp"
#include "planner/carrier/ride.hpp"

namespace aerogram::planner {
namespace {

/// What interpolating at every tick may take off a distance, metres; twice the 1 mm (100 ms) or 5 mm (200 ms) of two
/// drones whose jerk turns round between ticks.
constexpr double kRefit_m = 0.002, kCoarseRefit_m = 0.01;

double whole_ticks_s(double seconds, Millis tick_ms) {
    const auto ms = static_cast<Millis>(std::ceil(seconds * 1000.0 - 1e-6));
    return static_cast<double>(whole_ticks(ms, tick_ms)) / 1000.0;
}

void leave_room(Limits& limits, Millis tick_ms) {
    const double refit_m = tick_ms > 100 ? kCoarseRefit_m : kRefit_m;
    limits.export_margin_m += std::clamp(limits.formation_spacing_m - planned_separation_m(limits), 0.0, refit_m);
    if (!limits.plane) return;
    // Among themselves planes may do whatever the ride finds possible: acts that are too fast are lengthened there.
    limits.speed_horizontal_mps = limits.plane->airspeed_max_mps;
    limits.speed_up_mps = limits.plane->climb_mps;
    limits.speed_down_mps = limits.plane->sink_mps;
}

void place(Keyframe& keyframe, const Vec3& start_m, double yaw_rad) {
    const double c = std::cos(yaw_rad), s = std::sin(yaw_rad);
    const auto turned = [c, s](const Vec3& v) { return Vec3{c * v.x - s * v.y, s * v.x + c * v.y, v.z}; };
    keyframe.center_m = start_m + turned(keyframe.center_m);
    keyframe.rotate_rad.z += yaw_rad;  // the last of the three turns
    keyframe.motion.drift_m = turned(keyframe.motion.drift_m);
    for (Part& part : keyframe.parts) {
        auto* gradient = part.color ? std::get_if<Gradient>(&*part.color) : nullptr;
        if (gradient) gradient->direction = turned(gradient->direction);
    }
    if (!keyframe.motion.wave) return;
    keyframe.motion.wave->amplitude_m = turned(keyframe.motion.wave->amplitude_m);
    keyframe.motion.wave->direction = turned(keyframe.motion.wave->direction);
}

}  // namespace

Result<Mission> placed_at_start(const Mission& mission) {
    AEROGRAM_REQUIRE(mission.carrier.has_value());
    const auto path = CarrierPath::through(mission);
    if (!path) return path.error();
    const Millis tick_ms = ride_tick_ms(mission.fleet.drones);
    Mission placed = mission;
    leave_room(placed.limits, tick_ms);
    if (placed.fleet.spares == Spares::pads) placed.fleet.spares = Spares::wings;  // pads do not ride
    for (Keyframe& keyframe : placed.keyframes) {
        place(keyframe, path->at(0.0), mission.carrier->turn ? path->yaw_rad(0.0) : 0.0);
        keyframe.hold_s = whole_ticks_s(keyframe.hold_s, tick_ms);
        if (keyframe.at_s) keyframe.at_s = whole_ticks_s(*keyframe.at_s, tick_ms);
        if (keyframe.arrive.duration_s)
            keyframe.arrive.duration_s = whole_ticks_s(*keyframe.arrive.duration_s, tick_ms);
    }
    return placed;
}

}  // namespace aerogram::planner
