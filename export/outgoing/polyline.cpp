#include "export/outgoing/polyline.hpp"

#include <algorithm>

#include "geo/contract.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

constexpr double kRoundoff_m = 1e-9;

/// Whether the straight line from corner `from` to corner `to` passes all between within tolerance_m.
bool passes(std::span<const Corner> corners, std::size_t from, std::size_t to, double tolerance_m) {
    const Corner& a = corners[from];
    const Vec3 per_ms =
        (corners[to].place_m - a.place_m) * (1.0 / static_cast<double>(corners[to].time_ms - a.time_ms));
    const auto near = [&](std::size_t k) {
        const Vec3 off = corners[k].place_m - a.place_m - static_cast<double>(corners[k].time_ms - a.time_ms) * per_ms;
        return glm::dot(off, off) <= tolerance_m * tolerance_m;
    };
    const std::size_t middle = from + (to - from) / 2;  // where curves are farthest off
    if (middle > from && !near(middle)) return false;
    for (std::size_t k = from + 1; k < to; ++k) {
        if (!near(k)) return false;
    }
    return true;
}

/// A corner that a straight line from `from` reaches, when it does not reach the next: from a first guess on the steps
/// grow, then they are halved. @param guess  how many corners on, >= 1.
std::size_t reach(std::span<const Corner> corners, std::size_t from, std::size_t guess, double tolerance_m) {
    const std::size_t end = corners.size();
    std::size_t good = from + 1, bad = end;
    for (std::size_t to = from + std::max<std::size_t>(guess, 2), step = 1 + guess / 8; to < end; step *= 2) {
        if (!passes(corners, from, to, tolerance_m)) {
            bad = to;
            break;
        }
        good = to;
        if (to == end - 1) break;
        to = std::min(end - 1, to + step);
    }
    while (bad - good > 1) {
        const std::size_t middle = good + (bad - good) / 2;
        (passes(corners, from, middle, tolerance_m) ? good : bad) = middle;
    }
    return good;
}

}  // namespace

std::optional<Millis> sampling_step_ms(double acceleration_mps2, double allowed_m, std::span<const Millis> steps_ms) {
    for (const Millis step_ms : steps_ms) {
        const double dt_s = seconds_from_ms(step_ms);
        if (acceleration_mps2 * dt_s * dt_s / 8.0 <= allowed_m) return step_ms;
    }
    return std::nullopt;
}

std::vector<Millis> sampling_times(Millis duration_ms, Millis step_ms) {
    AEROGRAM_REQUIRE(duration_ms > 0 && step_ms > 0, duration_ms, step_ms);
    std::vector<Millis> times;
    times.reserve(static_cast<std::size_t>(duration_ms / step_ms) + 2);
    for (Millis t = 0; t < duration_ms; t += step_ms) times.push_back(t);
    const Millis last_ms = duration_ms - times.back();
    if (2 * last_ms < step_ms && times.size() > 1) times.back() = duration_ms - (step_ms + last_ms + 1) / 2;
    times.push_back(duration_ms);
    return times;
}

std::vector<Corner> sampled(const Flight& flight, std::span<const Millis> times_ms) {
    FlightCursor cursor(flight);
    std::vector<Corner> corners;
    corners.reserve(times_ms.size());
    for (const Millis t : times_ms) corners.push_back({t, cursor.position_at(seconds_from_ms(t))});
    return corners;
}

std::vector<Corner> thinned(std::span<const Corner> corners, double tolerance_m) {
    if (corners.size() < 3) return {corners.begin(), corners.end()};
    std::vector<Corner> kept{corners.front()};
    for (std::size_t at = 0, strode = 1; at + 1 < corners.size();) {
        const std::size_t next = reach(corners, at, strode, tolerance_m + kRoundoff_m);
        strode = next - at;
        at = next;
        kept.push_back(corners[at]);
    }
    return kept;
}

}  // namespace aerogram::exporter
