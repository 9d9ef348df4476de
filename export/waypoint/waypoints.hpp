#pragma once
#include "export/outgoing/format.hpp"

/// `waypoints/drone-001.waypoints`: QGC WPL 110, a text mission a drone (FORMATS.md 5, docs/formats/waypoints.md).
namespace aerogram::exporter {

/// Line 1 is `QGC WPL 110`; then 12 fields split by single tabs: seq, current, frame, command, p1..p4, latitude,
/// longitude, altitude, autocontinue. Item 0 is the planned home (frame 0, AMSL, not flown); places stand on frame 3,
/// above home, waits and speeds on frame 2. Eight decimals a degree, three of altitude; no blank lines, comments or
/// trailing tabs. For PX4, which has no home item, line 1 is `QGC WPL 120` and the take-off is item 0.
/// Timing as mission_items.hpp has it; times of day without a date, so show times that are read count from the first
/// wait. Colours, yaw, events, fence, hash and certificate are lost.
/// Reads other programs' missions too: CRLF, blank lines at the end, AMSL frames, commands that move nobody.
/// Errors: invalid_input with file and line.
[[nodiscard]] const Format& waypoints_format();

/// Format::read of waypoints_format().
Result<RecordedShow> read_waypoints(std::span<const FileBytes> files);

}  // namespace aerogram::exporter
