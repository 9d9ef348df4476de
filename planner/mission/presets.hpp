#pragma once
#include <optional>
#include <string_view>

#include "geo/limits.hpp"

namespace aerogram::planner {

enum class Preset { dense, standard, conservative, indoor };

/// The limits of a preset (MISSION.md's table), jerk = 4 x acceleration, export margin 0.05 m.
[[nodiscard]] Limits preset_limits(Preset preset);

/// Formation spacing in metres when the mission sets the separation but not the spacing: the preset's, or, where that
/// is less than sqrt(2) times the planned separation, that, rounded up to 0.05 m.
[[nodiscard]] double default_spacing_m(double planned_separation_m, double preset_spacing_m);

}  // namespace aerogram::planner
