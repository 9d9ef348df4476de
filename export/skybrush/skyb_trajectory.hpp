#pragma once
#include <cstdint>
#include <string>

#include "export/bytes/little_endian.hpp"
#include "export/outgoing/fitted.hpp"
#include "export/record/recorded_show.hpp"
#include "geo/result.hpp"

namespace aerogram::exporter {

/// The body of a trajectory block.
struct SkybTrajectory {
    std::string body;
    int scale_mm = 1;
    double rise_m = 0.0;  ///< of the rounded curve's joints above its start
    bool moves = false;
};

/// Millimetres a unit: the smallest with which every control point of the pieces, rounded, fits 16 bits; at least 1.
[[nodiscard]] int skyb_scale_mm(const Fitted& fitted);

/// Property: durations sum to duration_ms; what is before the first piece and after the last is held.
/// @param fitted  at least one piece. Errors: infeasible when the scale is above kSkybLargestScale, when the path jumps
/// by more than a unit, when pieces go on after duration_ms, or when the body is too large for a block.
Result<SkybTrajectory> skyb_trajectory(const Fitted& fitted, Millis duration_ms);

/// What a trajectory block holds.
struct ReadSkybTrajectory {
    int scale_mm = 1;
    double speed_factor = 0.0;         ///< largest 2 d / T of a piece that moves, d its degree or 3, 1/s
    double acceleration_factor = 0.0;  ///< largest 4 d (d - 1) / T², 1/s²
    double linear_jump_mps = 0.0;      ///< largest change of velocity at an end of a piece that is straight
};

/// Fills a drone's pieces, and its yaw where the trajectory's own counts. Segments without duration move the drone at
/// once. @param in  over the block's body; its problem is set for a body that is cut short or of scale 0.
[[nodiscard]] ReadSkybTrajectory read_skyb_trajectory(ByteCursor& in, RecordedDrone& drone);

}  // namespace aerogram::exporter
