#include "planner/mission/presets.hpp"

#include <cmath>
#include <numbers>

namespace aerogram::planner {

Limits preset_limits(Preset preset) {
    Limits l;  // "standard"
    switch (preset) {
        case Preset::standard:
            break;
        case Preset::dense:
            l.min_separation_m = 1.0;
            l.formation_spacing_m = 1.5;
            break;
        case Preset::conservative:
            l.min_separation_m = 2.0;
            l.formation_spacing_m = 3.0;
            l.speed_horizontal_mps = 4.0;
            l.speed_up_mps = 2.0;
            l.speed_down_mps = 1.5;
            l.acceleration_mps2 = 1.5;
            break;
        case Preset::indoor:
            l.min_separation_m = 0.35;
            l.formation_spacing_m = 0.5;
            l.downwash = 2.0;
            l.speed_horizontal_mps = 1.5;
            l.speed_up_mps = 1.0;
            l.speed_down_mps = 0.8;
            l.acceleration_mps2 = 1.5;
            l.ceiling_m = 6.0;
            l.min_navigation_altitude_m = 0.5;
            break;
        case Preset::airplane:
            l.plane.emplace();
            l.min_separation_m = 8.0;
            l.formation_spacing_m = 12.0;
            l.acceleration_mps2 = 9.8;  // a turn at 45 degrees of bank
            l.min_navigation_altitude_m = 30.0;
            l.ceiling_m = 150.0;
            break;
    }
    l.jerk_mps3 = default_jerk_mps3(l.acceleration_mps2, l.plane.has_value());
    return l;
}

double default_jerk_mps3(double acceleration_mps2, bool plane) {
    return plane ? acceleration_mps2 : 4.0 * acceleration_mps2;
}

double default_spacing_m(double planned_separation_m, double preset_spacing_m) {
    const double safe_m = std::numbers::sqrt2 * planned_separation_m;
    if (safe_m <= preset_spacing_m) return preset_spacing_m;
    return std::ceil(safe_m / 0.05 - 1e-9) / 20.0;
}

}  // namespace aerogram::planner
