#pragma once
#include "export/outgoing/format.hpp"

/// `skyb/drone-001.skyb`, ...: one Skybrush binary file a drone, what show firmware flies (FORMATS.md 2,
/// docs/formats/skyb.md).
namespace aerogram::exporter {

inline constexpr double kSkybLeastRise_m = 2.5;  ///< show firmware never takes off for a path that rises less
inline constexpr int kSkybLargestScale = 127;    ///< millimetres a unit of the 16-bit coordinates

/// What the curves of a show may miss by, so that two drones, rounded to half a unit of scale_mm, stay within the
/// export margin together; at most kFitPosition_m, not positive where there is no room.
[[nodiscard]] double skyb_fit_m(double export_margin_m, int scale_mm);

/// Stated accuracy: coordinates to half a unit (scale_mm, the smallest with which the drone's farthest control point
/// fits 16 bits), curves within skyb_fit_m, times exact: the durations of a file sum to the show's, to the millisecond.
///
/// Writes version 2 with CRC: trajectory (constant, linear or cubic an axis, whichever is exact after rounding; pieces
/// above a minute cut), light program, comment (title, names, show hash, certified mark, origin, home, landing place,
/// limits, endurance), yaw (0.1°, clockwise from +X), payload events. X front, Y left, Z up; home is the start.
/// Properties: (1) every instant is within 2 mm · scale of the refitted curve (2) durations sum exactly (3) same show,
/// same bytes, any thread count. Unsuited: planes, drones farther than the largest scale holds, curves that half-second
/// pieces cannot follow, blocks above 65,535 bytes, drones that move but never rise kSkybLeastRise_m.
[[nodiscard]] const Format& skyb_format();

/// Format::read of skyb_format(): one drone a file, named by its comment, else by its file. Reads other programs'
/// files: version 1 or 2, with or without CRC, degree 7, yaw inside the trajectory; unknown blocks and return plans are
/// skipped; of several blocks of one type the first counts. All files must be of one show.
/// Errors: invalid_input naming file and byte.
Result<RecordedShow> read_skyb(std::span<const FileBytes> files);

}  // namespace aerogram::exporter
