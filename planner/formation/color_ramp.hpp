#pragma once
#include <vector>

#include "geo/color.hpp"

namespace aerogram::planner {

/// Colours equally far apart on [0, 1], linear light between them. @param colors  >= 1. @param share  clamped to [0,
/// 1].
[[nodiscard]] Rgb ramp_color(const std::vector<Rgb>& colors, double share);

/// Colours equally far apart round a ring of length 1: the last goes over into the first.
/// @param colors  >= 1. @param share  any number; only its fraction counts.
[[nodiscard]] Rgb ring_color(const std::vector<Rgb>& colors, double share);

}  // namespace aerogram::planner
