#include "planner/sampling/bezier_line.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "geo/contract.hpp"

namespace aerogram::planner {

std::vector<Vec2> flattened(std::span<const Vec2> control, bool closed, double tolerance) {
    const std::size_t n = control.size();
    AEROGRAM_REQUIRE(tolerance > 0.0 && n >= 3 && n % 3 == (closed ? 0U : 1U), tolerance, n, closed);
    constexpr double kMostChords = 1000.0;
    std::vector<Vec2> out{control[0]};
    for (std::size_t i = 0; i + 3 < n + (closed ? 1 : 0); i += 3) {
        const Vec2 a = control[i], b = control[i + 1], c = control[i + 2], d = control[(i + 3) % n];
        // A chord of a curve with second derivative at most M strays at most M / 8 per squared step.
        const double bend = 6.0 * std::max(glm::length(a - 2.0 * b + c), glm::length(b - 2.0 * c + d));
        const auto chords =
            static_cast<int>(std::clamp(std::ceil(std::sqrt(bend / (8.0 * tolerance))), 1.0, kMostChords));
        for (int k = 1; k <= chords; ++k) {
            const double t = static_cast<double>(k) / chords, s = 1.0 - t;
            out.push_back(s * s * s * a + 3.0 * s * s * t * b + 3.0 * s * t * t * c + t * t * t * d);
        }
    }
    if (closed) out.pop_back();
    return out;
}

}  // namespace aerogram::planner
