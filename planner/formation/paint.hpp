#pragma once
#include <cstdint>
#include <vector>

#include "geo/color.hpp"
#include "geo/result.hpp"
#include "planner/mission/mission.hpp"

namespace aerogram::planner {

/// The colours that a paint gives to places in the show frame, one a place, linear.
/// @param seat_m  the audience's eyes (projected pictures). Properties: (1) deterministic (2) a gradient's first and
/// last colours are met at the ends of the places' box along its direction.
/// Errors: as read_picture, without line (projected pictures only).
Result<std::vector<Rgb>> painted(const Paint& paint, const Points& points_m, const Vec3& seat_m, std::uint64_t seed);

}  // namespace aerogram::planner
