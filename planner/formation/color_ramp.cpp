#include "planner/formation/color_ramp.hpp"

#include <algorithm>
#include <cmath>

#include "geo/contract.hpp"

namespace aerogram::planner {

Rgb ramp_color(const std::vector<Rgb>& colors, double share) {
    AEROGRAM_REQUIRE(!colors.empty());
    const std::size_t steps = colors.size() - 1;
    const double at = std::clamp(share, 0.0, 1.0) * static_cast<double>(steps);
    const auto before = static_cast<std::size_t>(at);
    if (before >= steps) return colors.back();
    return mix(colors[before], colors[before + 1], at - static_cast<double>(before));
}

Rgb ring_color(const std::vector<Rgb>& colors, double share) {
    AEROGRAM_REQUIRE(!colors.empty());
    const double at = (share - std::floor(share)) * static_cast<double>(colors.size());
    const std::size_t before = std::min(static_cast<std::size_t>(at), colors.size() - 1);
    return mix(colors[before], colors[(before + 1) % colors.size()], at - static_cast<double>(before));
}

}  // namespace aerogram::planner
