#pragma once
#include <optional>

namespace aerogram {

/// What a fixed-wing vehicle must hold beside the limits of every vehicle. Wind is not modelled: airspeed is the speed
/// over the ground, climb included. The values are a small show plane's, between ArduPilot's frame parameters of a
/// Parrot Disco (12 to 17 m/s) and a MyFlyDream Crosswind (16 to 29 m/s, 5 m/s climb); 30 degrees a second is a 45
/// degree bank at 18 m/s.
struct PlaneLimits {
    double airspeed_min_mps = 12.0;
    double airspeed_max_mps = 28.0;
    double turn_rate_dps = 30.0;  ///< of the heading, seen from above
    double climb_mps = 4.0;
    double sink_mps = 4.0;

    bool operator==(const PlaneLimits&) const = default;
};

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
    std::optional<PlaneLimits> plane =
        std::nullopt;  ///< present: the vehicles are planes, and the three speed limits do not apply
};

/// What the planner certifies: the minimum plus what the rounding of file formats may cost.
[[nodiscard]] constexpr double planned_separation_m(const Limits& l) {
    return l.min_separation_m + l.export_margin_m;
}

}  // namespace aerogram
