#pragma once
#include "export/outgoing/format.hpp"

/// `px4/Drone 1.csv` ...: rows of setpoints for mavsdk_drone_show (docs/formats/px4-csv.md).
namespace aerogram::exporter {

inline constexpr Millis kPx4Step_ms = 50;
/// What the straight line from row to row may miss a flight by, metres.
inline constexpr double kPx4Chord_m = 0.004;

/// Writes a file a drone, named by its number, `idx,t,px,py,pz,vx,vy,vz,ax,ay,az,yaw,mode,ledr,ledg,ledb`, 20 rows a
/// second and one at the end: exact states, metres north, east and down of the show's origin (north is +y where a show
/// has no origin), three decimals; yaw in degrees clockwise from north; mode 10 climbing, 70 showing, 100 landing;
/// 8-bit linear colours. `show.json` beside them (companion.hpp) tells the rest.
[[nodiscard]] const Format& px4_csv_format();

/// Format::read of px4_csv_format(): straight pieces from row to row, colours that hold from row to row. Other
/// programs' files: columns in any order, only t, px, py, pz are needed; without `show.json` +y is north. Rounding: 0.5
/// mm a coordinate, kPx4Chord_m for chords, √3 · 1 mm over the shortest interval for speeds; no accelerations. Errors:
/// invalid_input with file, line and column.
Result<RecordedShow> read_px4_csv(std::span<const FileBytes> files);

}  // namespace aerogram::exporter
