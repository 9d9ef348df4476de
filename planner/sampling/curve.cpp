#include "planner/sampling/curve.hpp"

#include <algorithm>
#include <vector>

namespace aerogram::planner {

Points equally_spaced(const std::function<Vec3(double t)>& curve, std::size_t count, bool closed, std::size_t steps) {
    steps += 16 * count;
    std::vector<double> along(steps + 1, 0.0);  // length up to t = i / steps
    Vec3 last = curve(0.0);
    for (std::size_t i = 1; i <= steps; ++i) {
        const Vec3 next = curve(static_cast<double>(i) / static_cast<double>(steps));
        along[i] = along[i - 1] + glm::distance(last, next);
        last = next;
    }
    const std::size_t gaps = closed ? count : std::max<std::size_t>(count - 1, 1);
    Points points;
    points.reserve(count);
    std::size_t i = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const double target = along.back() * static_cast<double>(k) / static_cast<double>(gaps);
        while (i + 1 < steps && along[i + 1] < target) ++i;
        const double step = along[i + 1] - along[i];
        const double share = step > 0.0 ? std::clamp((target - along[i]) / step, 0.0, 1.0) : 0.0;
        points.push_back(curve((static_cast<double>(i) + share) / static_cast<double>(steps)));
    }
    return points;
}

}  // namespace aerogram::planner
