#include "planner/carrier/noses.hpp"

#include <algorithm>
#include <cmath>

#include "geo/units.hpp"

namespace aerogram::planner {
namespace {

constexpr Millis kStep_ms = 200;
constexpr double kSlowest_mps = 0.1;
constexpr double kWithin_rad = 0.2 * kPi / 180.0;

/// The turn from `yaw` to a direction, within half a turn.
double nearest_turn(double yaw_rad, double direction_rad) {
    return std::remainder(direction_rad - yaw_rad, 2.0 * kPi);
}

std::vector<YawKey> every_step(std::span<const Act> acts, DroneId drone) {
    std::vector<YawKey> keys;
    const auto add = [&](const Act& act, Millis local_ms) {
        const Vec3 v = kinematics(act, drone, seconds_from_ms(local_ms)).velocity_mps;
        double yaw = keys.empty() ? 0.0 : keys.back().yaw_rad;
        if (std::hypot(v.x, v.y) >= kSlowest_mps) yaw += nearest_turn(yaw, std::atan2(-v.x, v.y));
        keys.push_back({act.start_ms + local_ms, yaw});
    };
    for (const Act& act : acts) {
        for (Millis local_ms = 0; local_ms < act.duration_ms; local_ms += kStep_ms) add(act, local_ms);
    }
    if (!acts.empty()) add(acts.back(), acts.back().duration_ms);
    return keys;
}

}  // namespace

std::vector<YawKey> noses_forward(std::span<const Act> acts, DroneId drone) {
    const std::vector<YawKey> all = every_step(acts, drone);
    if (all.size() < 3) return all;
    // From each key kept, the farthest one is kept to which a slope stays within the corridor of all keys between.
    std::vector<YawKey> kept{all.front()};
    const auto slope_to = [&](const YawKey& key, double offset) {
        const YawKey& from = kept.back();
        return (key.yaw_rad + offset - from.yaw_rad) / static_cast<double>(key.time_ms - from.time_ms);
    };
    double least = slope_to(all[1], -kWithin_rad), most = slope_to(all[1], kWithin_rad);
    for (std::size_t i = 2; i < all.size(); ++i) {
        const double slope = slope_to(all[i], 0.0);
        if (slope < least || slope > most) {
            kept.push_back(all[i - 1]);
            least = slope_to(all[i], -kWithin_rad);
            most = slope_to(all[i], kWithin_rad);
            continue;
        }
        least = std::max(least, slope_to(all[i], -kWithin_rad));
        most = std::min(most, slope_to(all[i], kWithin_rad));
    }
    kept.push_back(all.back());
    return kept;
}

}  // namespace aerogram::planner
