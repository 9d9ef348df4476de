#pragma once
#include "export/outgoing/outgoing_show.hpp"
#include "geo/airspace.hpp"
#include "geo/run.hpp"

namespace aerogram::exporter {

/// The three volumes that EU and UK authorities ask for (SORA): where the show flies, where a drone may come that has
/// left it, and where it could fall. Show frame, metres; heights above the origin's ground.
struct FlightVolumes {
    geo::Polygon flight_m;         ///< convex hull of every place that a drone is over
    geo::Polygon contingency_m;    ///< wider by S_CV = S_GPS + S_POS + S_K + v t + v² / (2 g tan φ), corners rounded
    geo::Polygon ground_risk_m;    ///< wider again by the contingency volume's height (1:1)
    double flight_height_m = 0.0;  ///< the highest place of any drone
    double contingency_height_m = 0.0;  ///< higher by S_CV as well
    double contingency_m_wide = 0.0, ground_risk_m_wide = 0.0;
    double speed_mps = 0.0;  ///< v: the speed limit
};

/// Properties: (1) no drone is ever outside flight_m and flight_height_m, to 1 mm; their corners and height are places
/// that a drone is at (a fleet above one line or point gets 1 cm of width) (2) each volume holds the one before,
/// everywhere by the stated width or up to 1 % more, where corners are rounded by straight lines (3) vertices run
/// counter-clockwise.
/// Degenerate: no drones, no volumes. Cost: about 0.1 ms a drone of a five-minute show. Source: FORMATS.md 7.
[[nodiscard]] FlightVolumes flight_volumes(const OutgoingShow& show, const Run& run);

}  // namespace aerogram::exporter
