#include "geo/tracks.hpp"

#include <algorithm>

#include "geo/units.hpp"

namespace aerogram {
namespace {

/// First key later than t_s. Times are compared in seconds: a key at 580 ms is there at 0.58 s whatever 0.58 * 1000
/// rounds to.
template <class Key>
typename std::span<const Key>::iterator first_after(std::span<const Key> keys, double t_s) {
    return std::upper_bound(keys.begin(), keys.end(), t_s,
                            [](double t, const Key& key) { return t < seconds_from_ms(key.time_ms); });
}

/// Share of the way from one key to a later one, [0, 1).
template <class Key>
double share(const Key& from, const Key& to, double t_s) {
    const double start_s = seconds_from_ms(from.time_ms);
    return (t_s - start_s) / (seconds_from_ms(to.time_ms) - start_s);
}

}  // namespace

Rgb light_at(std::span<const LightKey> keys, double t_s) {
    const auto next = first_after(keys, t_s);
    if (next == keys.begin()) return {};
    const LightKey& last = *(next - 1);
    if (!last.fade || next == keys.end()) return last.color;
    return mix(last.color, next->color, share(last, *next, t_s));
}

double yaw_at(std::span<const YawKey> keys, double t_s) {
    if (keys.empty()) return 0.0;
    const auto next = first_after(keys, t_s);
    if (next == keys.begin()) return next->yaw_rad;
    const YawKey& last = *(next - 1);
    if (next == keys.end()) return last.yaw_rad;
    return last.yaw_rad + (next->yaw_rad - last.yaw_rad) * share(last, *next, t_s);
}

}  // namespace aerogram
