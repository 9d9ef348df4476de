#pragma once

namespace aerogram {

/// What every vehicle must hold at every instant (MISSION.md, [limits]). Values are those of the "standard" preset.
/// Altitudes are above the drone's own pad. Separations and spacings are in SeparationMetric{downwash}.
struct Limits {
    double min_separation_m = 1.5;
    double formation_spacing_m = 2.2;
    double downwash = 1.0;
    double export_margin_m = 0.05;
    double speed_horizontal_mps = 5.0;
    double speed_up_mps = 2.5;
    double speed_down_mps = 2.0;
    double acceleration_mps2 = 2.0;
    double jerk_mps3 = 8.0;
    double min_navigation_altitude_m = 2.5;
    double ceiling_m = 120.0;
};

/// What the planner certifies: the minimum plus what the rounding of file formats may cost.
[[nodiscard]] constexpr double planned_separation_m(const Limits& l) {
    return l.min_separation_m + l.export_margin_m;
}

}  // namespace aerogram
