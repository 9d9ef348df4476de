#pragma once
#include "export/outgoing/format.hpp"

/// `show.czml`: a show for CesiumJS (docs/formats/czml.md).
namespace aerogram::exporter {

/// Writes a packet a line: the document with its clock, areas, then a packet a drone with position (seconds from the
/// epoch, longitude, latitude, metres above the ellipsoid; linear, held outside) and point colour over time. Show
/// facts (hash, certified mark, origin, limits, airspace) are in the document's properties. Yaw and payload events are
/// lost. Refuses shows without an origin, and texts beyond 500 MB: browsers hold none longer.
/// Reads other programs' files too: packets whose position is sampled as cartographicDegrees, cartographicRadians or
/// cartesian (fixed frame), times in seconds from an epoch or as dates, linear interpolation; colours that are sampled
/// or constant. Show time 0 is the earliest sample, the origin the first place of the first drone. Errors:
/// invalid_input with file, packet and key.
[[nodiscard]] const Format& czml_format();

/// Format::read of czml_format().
Result<RecordedShow> read_czml(std::span<const FileBytes> files);

}  // namespace aerogram::exporter
