#include "planner/formation/sizing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <utility>

namespace aerogram::planner {
namespace {

constexpr int kGrowthStepsAtMost = 200;

double rounded_up(double size_m) {
    return std::ceil(size_m * 10.0 - 1e-9) / 10.0;
}

double longest_side(const Figure& figure) {
    return std::max({figure.extent.x, figure.extent.y, figure.extent.z});
}

Points times(Points points, double factor) {
    for (Vec3& p : points) p *= factor;
    return points;
}

/// As a mission's size_m: a list, or a table of the sides that the figure has where a list would need one that it
/// lacks.
std::string as_written(const Vec3& size_m, bool flat_lists) {
    const bool wide = size_m.x > 0.0, deep = size_m.y > 0.0, high = size_m.z > 0.0;
    std::ostringstream text;
    if (wide && deep && high) {
        text << '[' << size_m.x << ", " << size_m.y << ", " << size_m.z << ']';
    } else if (flat_lists && wide && !deep) {
        text << '[' << size_m.x;
        if (high) text << ", " << size_m.z;
        text << ']';
    } else {
        text << '{';
        const char* separator = " ";
        for (const auto& [name, side_m] : {std::pair("width", size_m.x), {"depth", size_m.y}, {"height", size_m.z}}) {
            if (side_m > 0.0) text << std::exchange(separator, ", ") << name << " = " << side_m;
        }
        text << " }";
    }
    return text.str();
}

}  // namespace

std::optional<Vec3> asked_scale(const Vec3& extent, const Size& size) {
    const std::array<std::optional<double>, 3> wanted{size.width_m, size.depth_m, size.height_m};
    std::array<std::optional<double>, 3> scale;
    std::optional<double> smallest;
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        if (!wanted[a] || extent[axis] <= 0.0) continue;
        scale[a] = *wanted[a] / extent[axis];
        smallest = std::min(smallest.value_or(*scale[a]), *scale[a]);
    }
    if (!smallest) return std::nullopt;
    return Vec3(scale[0].value_or(*smallest), scale[1].value_or(*smallest), scale[2].value_or(*smallest));
}

SizedFigure sized(const Figure& figure, const Size& size, double spacing_m, const SpacingOf& spacing_of) {
    if (const auto scale = asked_scale(figure.extent, size)) return {figure.points(*scale), *scale};
    SizedFigure out{figure.points(Vec3(1.0)), Vec3(1.0)};
    const double longest = longest_side(figure);
    if (figure.in_metres || longest <= 0.0) return out;
    double longest_m = spacing_m;
    if (out.points_m.size() > 1) {
        const double natural = spacing_of(out.points_m);
        if (natural <= 0.0) return out;
        longest_m = rounded_up(longest * spacing_m / natural);
    }
    const double factor = longest_m / longest;
    return {times(std::move(out.points_m), factor), Vec3(factor)};
}

std::string needed_size(const Figure& figure, const SizedFigure& now, double spacing_m, const SpacingOf& spacing_of) {
    const Vec3 now_m = figure.extent * now.scale;
    double factor = spacing_m / spacing_of(now.points_m);
    Vec3 size_m{};
    for (int step = 0; step < kGrowthStepsAtMost; ++step, factor *= 1.005) {
        Vec3 scale(factor * std::min({now.scale.x, now.scale.y, now.scale.z}));
        for (int axis = 0; axis < 3; ++axis) {
            size_m[axis] = rounded_up(now_m[axis] * factor);
            if (figure.extent[axis] > 0.0) scale[axis] = size_m[axis] / figure.extent[axis];
        }
        // Rounding changes the aspect a little, and with it where the points go: try what the message will say.
        if (spacing_of(figure.points(scale)) >= spacing_m - kSpacingTolerance_m) break;
    }
    return as_written(size_m, !figure.in_metres);
}

}  // namespace aerogram::planner
