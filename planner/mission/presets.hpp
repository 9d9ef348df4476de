#pragma once
#include <optional>
#include <string_view>

#include "geo/limits.hpp"

namespace aerogram::planner {

enum class Preset { dense, standard, conservative, indoor, airplane };

/// The limits of a preset (MISSION.md's table), jerk = 4 x acceleration, export margin 0.05 m. `airplane` is that of
/// planes and alone has plane limits; its jerk is an acceleration a second, the time to roll into a turn.
[[nodiscard]] Limits preset_limits(Preset preset);
/// The jerk limit that goes with an acceleration limit.
[[nodiscard]] double default_jerk_mps3(double acceleration_mps2, bool plane);

/// Formation spacing in metres when the mission sets the separation but not the spacing: the preset's, or, where that
/// is less than sqrt(2) times the planned separation, that, rounded up to 0.05 m.
[[nodiscard]] double default_spacing_m(double planned_separation_m, double preset_spacing_m);

}  // namespace aerogram::planner
