#pragma once
#include <span>

#include "planner/mission/mission.hpp"
#include "planner/transition/turn.hpp"

namespace aerogram::planner {

/// The turn that brings the target formation onto the source's orientation: turned(result, 1, target) is aligned.
/// kabsch: the rotation with the least Σ|s_i - R t_i|². Collinear formations take the shortest turn between their
/// lines; where the best rotation is not unique (a mirrored round formation, points at their barycentre) nothing is
/// turned. pca: principal axes onto principal axes, by the proper sign choice of the smallest angle; falls back to
/// kabsch when a formation is round (two moments within 1e-6 of the largest) or two choices tie (traces within 1e-9).
/// none: no turn.
/// @param source_m, target_m  barycentre at the origin, same drones.
/// Properties: (1) moving both rigidly turns the result's axis with them, but for half turns of collinear formations,
/// which go about show y (x when y is along the line).
[[nodiscard]] Turn alignment_turn(std::span<const Vec3> source_m, std::span<const Vec3> target_m, Align align);

/// The axis with the sign that turns with the formation: to the side of the lowest-numbered drone off its plane; for a
/// formation square to it, counter-clockwise from the lowest-numbered drones; for the rest towards show y, then x, then
/// z.
[[nodiscard]] Vec3 oriented(const Vec3& axis, std::span<const Vec3> centred_m);

/// The formation's thinnest principal axis, oriented; show y where that is not unique (moments within 1e-6 of the
/// largest).
[[nodiscard]] Vec3 thinnest_axis(std::span<const Vec3> centred_m);

/// The mean of the points.
[[nodiscard]] Vec3 barycentre(std::span<const Vec3> points_m);

}  // namespace aerogram::planner
