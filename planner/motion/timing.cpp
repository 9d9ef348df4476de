#include "planner/motion/timing.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace aerogram::planner {
namespace {

constexpr double kNobodyMoves_m = 1e-9;  ///< rounding noise is no movement

/// Largest differences of neighbouring rows, over all drones: what the limited quantities are in units of the knot
/// step.
struct Differences {
    double horizontal_m = 0.0, up_m = 0.0, down_m = 0.0;  ///< of ΔP
    double second_m = 0.0, third_m = 0.0;                 ///< |Δ²P|, |Δ³P|
};

double squared(const Vec3& d) {
    return glm::dot(d, d);
}

void take_first(Differences& d, const Vec3& step) {
    d.horizontal_m = std::max(d.horizontal_m, glm::length(Vec2(step)));
    d.up_m = std::max(d.up_m, step.z);
    d.down_m = std::max(d.down_m, -step.z);
}

Differences differences(const Straight& straight) {
    const auto& s = straight.profile;
    double first = 0.0, second = 0.0, third = 0.0;
    for (std::size_t k = 0; k + 1 < s.size(); ++k) first = std::max(first, std::abs(s[k + 1] - s[k]));
    for (std::size_t k = 0; k + 2 < s.size(); ++k)
        second = std::max(second, std::abs(s[k + 2] - 2.0 * s[k + 1] + s[k]));
    for (std::size_t k = 0; k + 3 < s.size(); ++k) {
        third = std::max(third, std::abs(s[k + 3] - 3.0 * s[k + 2] + 3.0 * s[k + 1] - s[k]));
    }
    Differences d;
    for (std::size_t i = 0; i < straight.from_m.size(); ++i) {
        const Vec3 way = straight.to_m[i] - straight.from_m[i];
        take_first(d, way * first);
        d.second_m = std::max(d.second_m, glm::length(way) * second);
        d.third_m = std::max(d.third_m, glm::length(way) * third);
    }
    return d;
}

Differences differences(const Lattice& lattice) {
    Differences d;
    const std::size_t rows = lattice.rows();
    double horizontal2 = 0.0, second2 = 0.0, third2 = 0.0;  // one root at the end
    for (std::size_t k = 0; k + 1 < rows; ++k) {
        for (std::size_t i = 0; i < lattice.drones; ++i) {
            const Vec3 first = lattice.at(k + 1, i) - lattice.at(k, i);
            horizontal2 = std::max(horizontal2, first.x * first.x + first.y * first.y);
            d.up_m = std::max(d.up_m, first.z);
            d.down_m = std::max(d.down_m, -first.z);
            if (k + 2 >= rows) continue;
            const Vec3 next = lattice.at(k + 2, i) - lattice.at(k + 1, i);
            second2 = std::max(second2, squared(next - first));
            if (k + 3 >= rows) continue;
            const Vec3 last = lattice.at(k + 3, i) - lattice.at(k + 2, i);
            third2 = std::max(third2, squared(last - 2.0 * next + first));
        }
    }
    d.horizontal_m = std::sqrt(horizontal2);
    d.second_m = std::sqrt(second2);
    d.third_m = std::sqrt(third2);
    return d;
}

Differences differences(const Motion& motion) {
    if (const auto* straight = std::get_if<Straight>(&motion)) return differences(*straight);
    if (const auto* lattice = std::get_if<Lattice>(&motion)) return differences(*lattice);
    return {};
}

}  // namespace

Extremes extremes(const Motion& motion, double duration_s) {
    const Differences d = differences(motion);
    const double h = duration_s / static_cast<double>(interval_count(motion));
    return {d.horizontal_m / h, d.up_m / h, d.down_m / h, d.second_m / (h * h), d.third_m / (h * h * h)};
}

ShortestDuration shortest_duration(const Motion& motion, const Limits& limits) {
    const Differences d = differences(motion);
    struct Need {
        double step_s;
        const char* limit;
    };
    const std::array<Need, 5> needs = {{{d.horizontal_m / limits.speed_horizontal_mps, "speed_horizontal_mps"},
                                        {d.up_m / limits.speed_up_mps, "speed_up_mps"},
                                        {d.down_m / limits.speed_down_mps, "speed_down_mps"},
                                        {std::sqrt(d.second_m / limits.acceleration_mps2), "acceleration_mps2"},
                                        {std::cbrt(d.third_m / limits.jerk_mps3), "jerk_mps3"}}};
    const Need& most =
        *std::max_element(needs.begin(), needs.end(), [](const Need& a, const Need& b) { return a.step_s < b.step_s; });
    if (std::max({d.horizontal_m, d.up_m, d.down_m}) <= kNobodyMoves_m) return {0, ""};
    const double duration_ms = most.step_s * static_cast<double>(interval_count(motion)) * 1000.0;
    return {std::max<Millis>(1, static_cast<Millis>(std::ceil(duration_ms))), most.limit};
}

}  // namespace aerogram::planner
