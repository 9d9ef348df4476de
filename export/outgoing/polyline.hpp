#pragma once
#include <optional>
#include <span>
#include <vector>

#include "export/outgoing/flight.hpp"
#include "geo/tracks.hpp"

/// Flights as straight lines in time, for formats that know no curves.
namespace aerogram::exporter {

/// Where a drone is at an instant; between two corners it flies straight, at constant speed.
struct Corner {
    Millis time_ms = 0;
    Vec3 place_m{};
};

/// The largest of steps_ms at which straight lines between exact positions stay within allowed_m of a flight with this
/// acceleration (a dt² / 8), or absent. @param steps_ms  falling.
[[nodiscard]] std::optional<Millis> sampling_step_ms(double acceleration_mps2, double allowed_m,
                                                     std::span<const Millis> steps_ms);

/// Multiples of the step below the duration, and the exact end. An end closer than half a step to its predecessor moves
/// that one to the middle of the last two intervals: none is below half a step, and rounding makes no false speeds.
/// @param duration_ms  > 0. @param step_ms  > 0.
[[nodiscard]] std::vector<Millis> sampling_times(Millis duration_ms, Millis step_ms);

/// Exact positions at the times, which rise.
[[nodiscard]] std::vector<Corner> sampled(const Flight& flight, std::span<const Millis> times_ms);

/// As few of the corners as a greedy pass finds to do; first and last stay. @param corners  times rise. Properties: (1)
/// the line through those that are left is within tolerance_m of every corner, so of the line through all of them at
/// every instant (2) a drone that stands costs two corners (3) tolerance 0 leaves out only corners that lie on the line
/// (to 1e-9 m). Cost: n log n; about 15 ns a corner.
[[nodiscard]] std::vector<Corner> thinned(std::span<const Corner> corners, double tolerance_m);

}  // namespace aerogram::exporter
