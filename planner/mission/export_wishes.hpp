#pragma once
#include <cstddef>
#include <optional>

#include "geo/utc.hpp"

/// What a mission says about its files and its report ([export], [report]). The planner only passes it on.
namespace aerogram::planner {

/// How waypoint missions keep time: not at all, by waiting for a UTC time at each keyframe, or by a speed for each leg.
enum class WaypointTiming { none, absolute, speed };
enum class Autopilot { ardupilot, px4 };
/// Which way Z points in a VVIZ file: forward (Verge Aero) or backward (Finale 3D).
enum class VvizFlavour { verge, finale };

struct ExportWishes {
    WaypointTiming timing = WaypointTiming::none;
    std::optional<UtcSeconds> start_utc_s;  ///< of show time 0
    Autopilot autopilot = Autopilot::ardupilot;
    std::size_t mission_items = 650;  ///< what the board holds, home included
    // How the autopilot flies a leg between waypoints, for the proof that it arrives in time. Speeds absent: the
    // limits'.
    std::optional<double> leg_speed_mps, leg_speed_up_mps, leg_speed_down_mps;
    double leg_acceleration_mps2 = 1.0;
    double leg_jerk_mps3 = 1.0;
    double slack_s = 2.0;  ///< at least this much must be left when a vehicle arrives
    VvizFlavour vviz = VvizFlavour::verge;
};

/// Distances and speeds absent: from the limits, as docs/report.md says.
struct ReportWishes {
    double wind_mps = 8.0;          ///< the most in which the show may fly
    double reserve_percent = 15.0;  ///< of the endurance, left at landing
    std::optional<double> return_altitude_m, return_layer_m;
    std::optional<double> return_speed_mps, land_speed_mps;
    // Contingency volume (SORA): what positioning, path and map may be off by, metres; reaction, s; bank, degrees.
    double volume_gps_m = 3.0, volume_path_m = 3.0, volume_map_m = 1.0, volume_reaction_s = 1.0;
    double volume_bank_deg = 45.0;
};

}  // namespace aerogram::planner
