#pragma once
#include <span>
#include <vector>

#include "export/outgoing/fitted.hpp"
#include "export/outgoing/flight.hpp"
#include "export/vehicle/septic.hpp"
#include "geo/limits.hpp"

/// A flight on few polynomials of degree 7.
namespace aerogram::exporter {

/// What fits in a Crazyflie's 4,096 bytes: 31 pieces of 33 floats.
inline constexpr std::size_t kCrazyfliePieces = 31;

struct SepticFit {
    std::vector<SepticPiece> pieces;  ///< without gaps, from 0; all that are needed, also beyond kCrazyfliePieces
    FitError error;                   ///< sound upper bounds, rounding to floats included
};

/// Where a drone stands it gets one piece; between, and from yaw key to yaw key, pieces as long as an aim lets them,
/// each with place, velocity and acceleration of the flight at its ends and the least squares between. Aims: 4 mm,
/// then what the export margin leaves (fit_bound), until no more than kCrazyfliePieces are needed. Yaw is exact.
/// Properties: (1) place, velocity and acceleration are continuous, but for rounding, where the flight's are (2) the
/// error is an upper bound of a dense sampling's (3) a drone that stands all the time gives one piece a yaw key.
/// Cost: a few ms for ten minutes.
[[nodiscard]] SepticFit septic_fit(const Flight& flight, const std::vector<YawKey>& yaw, const Limits& limits);

}  // namespace aerogram::exporter
