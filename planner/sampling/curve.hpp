#pragma once
#include <cstddef>
#include <functional>

#include "geo/vec3.hpp"

namespace aerogram::planner {

/// Equally spaced points along a curve, measured along it.
/// @param curve  position at t in [0, 1], continuous. @param count  >= 1.
/// @param closed  curve(1) = curve(0), and the last point stands one spacing before the first; else both ends are
/// occupied (a single point stands at curve(0)). @param steps  at least this many chords measure it: more for curves
/// that wind a lot. Accuracy: for smooth curves the spacings agree to 1e-6 of the length.
[[nodiscard]] Points equally_spaced(const std::function<Vec3(double t)>& curve, std::size_t count, bool closed,
                                    std::size_t steps = 4096);

}  // namespace aerogram::planner
