#pragma once
#include <functional>
#include <optional>
#include <string>

#include "geo/vec3.hpp"
#include "planner/formation/figure.hpp"
#include "planner/mission/mission.hpp"

namespace aerogram::planner {

inline constexpr double kSpacingTolerance_m = 1e-9;  ///< spacings this much below what is asked are rounding

/// The smallest spacing, metres in the separation metric, once a figure's points stand as the keyframe turns them.
using SpacingOf = std::function<double(const Points& points)>;

/// A figure at its final size, not yet turned.
struct SizedFigure {
    Points points_m;
    Vec3 scale{1.0};
};

/// How a mission's size stretches a figure of that natural extent; absent where it names no side that the figure has.
/// Absent components follow the aspect (of two that are given, the smaller scale).
[[nodiscard]] std::optional<Vec3> asked_scale(const Vec3& extent, const Size& size);

/// A figure stretched to `size` (asked_scale). Without any: as it is when its unit is the metre, else the smallest size
/// that holds `spacing_m`, its longest side rounded up to 0.1 m (one point alone: a longest side of spacing_m).
[[nodiscard]] SizedFigure sized(const Figure& figure, const Size& size, double spacing_m, const SpacingOf& spacing_of);

/// The size with the same aspect, in steps of 0.1 m, at which a figure too narrow now holds `spacing_m`, as a mission
/// writes it: "[18.5, 24.7]" for flat figures, "[18.5, 18.5, 24.7]" for solid ones, "{ height = 24.7 }" where sides are
/// missing.
[[nodiscard]] std::string needed_size(const Figure& figure, const SizedFigure& now, double spacing_m,
                                      const SpacingOf& spacing_of);

}  // namespace aerogram::planner
