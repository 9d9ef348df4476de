#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "export/outgoing/outgoing_show.hpp"
#include "export/outgoing/polyline.hpp"
#include "export/record/recorded_show.hpp"

/// A drone's flight as the corners of a line in time, thinned within the error that both map formats state.
namespace aerogram::exporter {

/// What a drone's line may be off its curve by, metres: both map formats' Rounding::fit_m.
inline constexpr double kMapFit_m = 0.02;
/// Nine decimals of a degree are 0.06 mm north and east; heights have three decimals.
inline constexpr double kMapHalfDigit_m = 0.0005;

/// How flights are cut: sampled every step_ms, then thinned.
struct MapCut {
    Millis step_ms = 0;
    double tolerance_m = 0.0;
};

/// The cut with chord error and tolerance together within kMapFit_m, and within what the export margin leaves to each
/// of two drones after rounding. Absent when the margin leaves nothing, or the show is too sharp for samples every
/// 10 ms.
[[nodiscard]] std::optional<MapCut> map_cut(const OutgoingFacts& facts);

/// Properties: (1) the line through the corners is within kMapFit_m of the flight at every instant (2) the ends of the
/// climb and of the show before landing are corners, so that neither is cut short (3) where the flight's velocity jumps
/// there is a sample, on the nearest millisecond (4) times rise, from 0 to the show's duration.
[[nodiscard]] std::vector<Corner> track_corners(const OutgoingShow& show, std::size_t drone, const MapCut& cut);

/// How many corners all drones have together, from a few of them.
[[nodiscard]] double estimated_corners(const OutgoingShow& show, const MapCut& cut);

/// What readers of own files state: rounding and fit as above; speeds by two rounded points over the show's shortest
/// interval; no accelerations.
[[nodiscard]] Rounding map_rounding(const RecordedShow& show, double half_digit_m, double fit_m);

/// Pieces from corner to corner. @param times_s  rising, as many as places, at least one: of a single one the drone
/// stands there for a second.
void set_pieces(RecordedDrone& drone, const std::vector<double>& times_s, std::vector<Vec3> places_m);

}  // namespace aerogram::exporter
