#pragma once
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geo/airspace.hpp"
#include "geo/limits.hpp"
#include "geo/show_frame.hpp"
#include "geo/tracks.hpp"
#include "planner/mission/export_wishes.hpp"
#include "planner/motion/act.hpp"
#include "planner/motion/certificate.hpp"

namespace aerogram::planner {

/// A keyframe as it will be flown. Indices: formation_m and colors by SLOT; slot_of by DRONE.
struct PlannedKeyframe {
    std::string name;
    Points formation_m;
    std::vector<Rgb> colors;
    std::vector<SlotId> slot_of;
    Millis stands_from_ms = 0;  ///< the formation stands from here
    Millis stands_to_ms = 0;    ///< to here; equal where a flow passes
    std::vector<bool> spare{};  ///< by SLOT: the drone waits here, dark; empty: nobody does
    double turned_rad = 0.0;    ///< how far a carrier has turned the formation from the mission's own axes by then
};

/// The whole show: acts on one clock from take-off to landing, and what each drone does beside moving.
struct FlightPlan {
    std::string name;
    geo::ShowOrigin origin;
    Limits limits;
    geo::Airspace airspace;
    double endurance_s = 900.0;
    Points pads_m;                ///< one a drone: home and landing place
    std::vector<PadId> pad_of{};  ///< by drone; empty: drone 1 stands on pad 1, and so on
    Points spare_pads_m;          ///< pads that no drone uses, numbered on from the last drone's
    std::vector<Act> acts;        ///< in order, without gaps; acts[0].start_ms = 0
    std::vector<Tracks> tracks;   ///< one a drone
    std::vector<PlannedKeyframe> keyframes;
    std::vector<Cue> cues;
    std::optional<std::filesystem::path> audio;
    ExportWishes exporting;
    ReportWishes reporting;
    Certificate certificate;

    [[nodiscard]] std::size_t drones() const { return pads_m.size(); }
    [[nodiscard]] Millis duration_ms() const { return acts.empty() ? 0 : acts.back().end_ms(); }
};

/// One drone at one instant.
struct DroneState {
    Kinematics motion;
    double yaw_rad = 0.0;
    Rgb color;
};

/// The act that runs at t_s (clamped to the show); at a boundary the later one.
[[nodiscard]] std::size_t act_at(const FlightPlan& plan, double t_s);
/// One drone at show time t_s, seconds (clamped to the show).
[[nodiscard]] DroneState sample(const FlightPlan& plan, DroneId drone, double t_s);
/// The whole fleet. @param out  plan.drones() places.
void sample(const FlightPlan& plan, double t_s, std::span<DroneState> out);

}  // namespace aerogram::planner
