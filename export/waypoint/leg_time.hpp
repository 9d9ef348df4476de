#pragma once
#include "geo/limits.hpp"
#include "geo/vec3.hpp"
#include "planner/mission/export_wishes.hpp"

/// How long an autopilot takes from one waypoint to the next, from standing to standing.
namespace aerogram::exporter {

/// What the autopilot is set to. Along a leg the speed is the largest whose horizontal part and whose climb or descent
/// stay within these; acceleration and jerk are of the leg itself.
struct LegModel {
    double speed_mps = 5.0, speed_up_mps = 2.5, speed_down_mps = 2.0;
    double acceleration_mps2 = 1.0, jerk_mps3 = 1.0;
};
/// The speeds that the mission states, else the limits'.
[[nodiscard]] LegModel leg_model(const planner::ExportWishes& wishes, const Limits& limits);

/// The jerk does not jump either: ArduCopter lets it rise within twice ATC_INPUT_TC, whose default is 0.15 s; this
/// allows 0.2 s.
inline constexpr double kJerkRise_s = 0.4;
/// Whole seconds, at least one: autopilots store holds so, and meet only waypoints they stop at.
inline constexpr double kShortestHold_s = 1.0;
/// Noticing the arrival, the end of the hold and the end of the wait: the mission is looked at ten times a second.
inline constexpr double kMissionSteps_s = 0.5;
/// From the start of the mission until the vehicle leaves the ground: motors spool up, the load shifts to them.
inline constexpr double kLiftOff_s = 3.0;

/// The largest speed along a leg. @param way_m  not zero.
[[nodiscard]] double leg_speed_mps(const LegModel& model, const Vec3& way_m);
/// From standing to standing over length_m at no more than speed_mps: time-optimal S-curve, whose jerk rises and falls
/// like a raised cosine; 0 for less than a micrometre.
/// Properties: (1) the profile that takes this long covers length_m and holds speed, acceleration and jerk (2) longer
/// or slower legs take longer (3) without ramps it would be length / speed. Accuracy: 1e-9 s.
/// Source: the phases of ArduPilot's SCurve::calculate_path (AP_Math, read in 2026), solved here anew.
[[nodiscard]] double s_curve_s(const LegModel& model, double speed_mps, double length_m);
/// From leaving one waypoint to the end of the shortest hold at the next: ramps, hold and mission steps.
[[nodiscard]] double leg_needs_s(const LegModel& model, const Vec3& way_m);
/// From the start of the mission to hovering at climb_m above the pad.
[[nodiscard]] double takeoff_needs_s(const LegModel& model, double climb_m);
/// The speed along a leg at which s_curve_s is duration_s; the largest where even that is too slow.
[[nodiscard]] double speed_for_s(const LegModel& model, const Vec3& way_m, double duration_s);

}  // namespace aerogram::exporter
