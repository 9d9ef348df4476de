#pragma once
#include "export/outgoing/format.hpp"

/// `csv.zip`: one Skybrush CSV a drone (FORMATS.md 3, docs/formats/csv-zip.md).
namespace aerogram::exporter {

/// The pair bound that the row step is chosen for, metres: what chords and rounding may cost two drones together.
inline constexpr double kCsvPairCost_m = 0.05;

/// Milliseconds between rows: the largest of 250, 200, 125, 100, 50, 40, 25, 20, 10 with
/// a dt² / 4 + √3 · 1 mm <= min(export margin, kCsvPairCost_m), a the show's largest acceleration: two chords of
/// a dt² / 8 and two rounded points. Absent when none does.
[[nodiscard]] std::optional<Millis> csv_row_step_ms(const OutgoingFacts& facts);

/// Writes the header `Time [msec],x [m],y [m],z [m],Red,Green,Blue`, whole milliseconds, three decimals, X front, Y
/// left, Z up, 8-bit linear colours, linear from row to row. Yaw, events, cues, origin, limits and the hash are lost.
/// Reads other programs' archives too: byte order mark, CRLF, header in any case, further columns, blank last lines.
/// Errors: invalid_input with archive, file and line.
[[nodiscard]] const Format& csv_format();

}  // namespace aerogram::exporter
