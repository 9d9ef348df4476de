#include "export/outgoing/polyline.hpp"

#include <algorithm>

#include "geo/contract.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

constexpr double kRoundoff_m = 1e-9;

/// Whether the straight line from corner `from` to corner `to` passes all between within tolerance_m.
bool passes(std::span<const Corner> corners, std::size_t from, std::size_t to, double tolerance_m) {
    const Corner &a = corners[from], &b = corners[to];
    const double length = static_cast<double>(b.time_ms - a.time_ms);
    for (std::size_t k = from + 1; k < to; ++k) {
        const double u = static_cast<double>(corners[k].time_ms - a.time_ms) / length;
        const Vec3 off = corners[k].place_m - (a.place_m + u * (b.place_m - a.place_m));
        if (glm::dot(off, off) > tolerance_m * tolerance_m) return false;
    }
    return true;
}

/// The farthest corner that a straight line from `from` reaches: doubling, then halving.
std::size_t reach(std::span<const Corner> corners, std::size_t from, double tolerance_m) {
    const std::size_t last = corners.size() - 1;
    std::size_t good = from + 1, step = 1;
    while (good < last) {
        const std::size_t next = std::min(last, good + step);
        if (!passes(corners, from, next, tolerance_m)) break;
        good = next;
        step *= 2;
    }
    for (std::size_t bad = std::min(last + 1, good + step); bad - good > 1;) {
        const std::size_t middle = good + (bad - good) / 2;
        (middle <= last && passes(corners, from, middle, tolerance_m) ? good : bad) = middle;
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
    for (Millis t = 0; t < duration_ms; t += step_ms) times.push_back(t);
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
    for (std::size_t at = 0; at + 1 < corners.size();) {
        at = reach(corners, at, tolerance_m + kRoundoff_m);
        kept.push_back(corners[at]);
    }
    return kept;
}

}  // namespace aerogram::exporter
