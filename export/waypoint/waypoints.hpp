#pragma once
#include "export/outgoing/format.hpp"

/// `waypoints/drone-001.waypoints`: QGC WPL 110, a text mission a drone (FORMATS.md 5, docs/formats/qgc.md).
namespace aerogram::exporter {

/// Line 1 is `QGC WPL 110`; then 12 fields split by single tabs: seq, current, frame, command, p1..p4, latitude,
/// longitude, altitude, autocontinue. Item 0 is the planned home (frame 0, AMSL, not flown); the rest stands on frame
/// 3, above home. Eight decimals a degree, three of altitude; no blank lines, comments or trailing tabs.
/// Timing "none": the mission says where, not when; colours, yaw, events, fence, hash and certificate are lost.
/// Reads other programs' missions too: CRLF, blank lines at the end, AMSL frames, commands that move nobody.
/// Errors: invalid_input with file and line.
[[nodiscard]] const Format& waypoints_format();

/// Format::read of waypoints_format().
Result<RecordedShow> read_waypoints(std::span<const FileBytes> files);

}  // namespace aerogram::exporter
