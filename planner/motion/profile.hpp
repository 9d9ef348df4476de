#pragma once
#include <vector>

#include "planner/mission/mission.hpp"

namespace aerogram::planner {

/// Share of the way at share u of the time, both in [0, 1]: S(0) = 0, S(1) = 1, monotone, at rest at both ends.
/// minimum_jerk: 10u³ - 15u⁴ + 6u⁵. trapezoid: constant acceleration for a third, cruise, the same down (speed
/// peak 1.5). s_curve: the trapezoid with its acceleration ramped over half of each acceleration phase's ends.
[[nodiscard]] double profile_value(ProfileKind kind, double u);

/// Control values of the profile as a cubic B-spline: s[k] = S((k-1)/(rows-3)) with the first three 0 and the last
/// three 1.
/// @param rows  K >= 7.
[[nodiscard]] std::vector<double> profile_rows(ProfileKind kind, std::size_t rows);

/// Share of the time at which the spline of non-decreasing rows (a Straight's profile) has come to share s of the way;
/// 0 for s <= 0. By bisection, to 1e-15.
[[nodiscard]] double time_share_at(const std::vector<double>& rows, double s);

}  // namespace aerogram::planner
