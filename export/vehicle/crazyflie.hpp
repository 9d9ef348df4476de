#pragma once
#include "export/outgoing/format.hpp"

/// `crazyflie/drone-001.csv` ...: polynomials of degree 7 (docs/formats/crazyflie.md).
namespace aerogram::exporter {

/// Crazyflies are told apart by one byte.
inline constexpr std::size_t kMostCrazyflies = 255;

/// Writes a file a drone in the layout of uav_trajectories, which Crazyswarm loads:
/// `duration,x^0,...,x^7,y^0,...,z^7,yaw^0,...,yaw^7`, a piece a line, X front, Y left, Z up, metres, radians, seconds;
/// floats with the digits that give them back. At most 31 pieces (septic_fit.hpp). `show.json` beside them
/// (companion.hpp) tells the rest.
[[nodiscard]] const Format& crazyflie_format();

/// Format::read of crazyflie_format(): pieces of degree 7; numbers are rounded to floats, as the vehicle gets them.
/// Other programs' files: any header, further columns, any number of pieces. Rounding: of the coefficients, summed over
/// each piece; the fit is fit_bound's. Errors: invalid_input with file, line and column.
Result<RecordedShow> read_crazyflie(std::span<const FileBytes> files);

}  // namespace aerogram::exporter
