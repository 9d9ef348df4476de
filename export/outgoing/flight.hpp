#pragma once
#include <cstddef>
#include <vector>

#include "export/record/recorded_show.hpp"
#include "geo/vec3.hpp"

namespace aerogram::exporter {

/// One drone's flight: Bézier pieces in time order and without gaps, from 0 to the show's end; show frame.
struct Flight {
    std::vector<Piece> pieces;
    std::vector<Vec3> controls_m;
};

/// Where a drone is, how fast, and how its speed changes.
struct FlightState {
    Vec3 position_m{}, velocity_mps{}, acceleration_mps2{};
};

/// Walks along a flight. Asking for times that do not go back costs a few nanoseconds each.
class FlightCursor {
  public:
    /// @param flight  at least one piece; must outlive the cursor.
    explicit FlightCursor(const Flight& flight) : flight_(flight) {}

    /// Position at t_s, seconds; the first and last points hold outside the flight. Where two pieces meet, the later.
    [[nodiscard]] Vec3 position_at(double t_s);
    /// Position, m/s and m/s² at t_s; the last two are zero outside the flight.
    [[nodiscard]] FlightState state_at(double t_s);

  private:
    [[nodiscard]] const Piece& go_to(double t_s);

    const Flight& flight_;
    std::size_t piece_ = 0;
};

/// The largest acceleration of the flight, m/s²: an upper bound from its control points, exact up to degree 3. Jumps of
/// the velocity where pieces meet are not in it.
[[nodiscard]] double largest_acceleration_mps2(const Flight& flight);

}  // namespace aerogram::exporter
