#pragma once
#include "export/outgoing/fitted.hpp"
#include "export/outgoing/flight.hpp"
#include "geo/limits.hpp"

namespace aerogram::exporter {

/// A recorded flight on C1 cubics of at least kShortestPieceMs.
///
/// Where the drone stands for half a second or more there is one standing piece; between two of these the recorded
/// pieces pass as they are when all are cubic or lower, at least half a second, on whole milliseconds, and speeds
/// differ by no more than kSameSpeed_mps where they meet. Else the stretch is cut into n near-equal pieces of whole
/// milliseconds, cubics with the flight's position at their ends and its velocity there (averaged over half a recorded
/// piece to both sides, so that lines in time give back the speeds they were sampled from); n is the smallest of 1, 2,
/// 3, 4, 6, 8, ..., the largest possible, that meets fit_aim, else the largest.
/// Properties: (1) position and, to kSameSpeed_mps, velocity are continuous (2) pieces cover [0, duration] without gaps
/// (3) the error bounds a dense sampling's; where the flight's own speed jumps, the velocity is compared with all those
/// between before and after on the half pieces beside the jump (4) a flight that is such cubics already is exact.
/// @param flight  from 0 to duration_ms, at least one piece.
[[nodiscard]] Fitted piecewise_fit(const Flight& flight, Millis duration_ms, const Limits& limits);

inline constexpr double kSameSpeed_mps = 0.02;

}  // namespace aerogram::exporter
