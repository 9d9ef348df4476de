#pragma once
#include <string>
#include <string_view>

#include "export/outgoing/format.hpp"

/// `show.kmz`: a show for Google Earth and other viewers of KML, and what authorities ask for (docs/formats/kmz.md).
namespace aerogram::exporter {

/// Fleets beyond this leave their tracks to linked files in the archive, so many drones each.
inline constexpr std::size_t kKmlDrones = 1'000;

/// Writes doc.kml in a ZIP: a gx:Track a drone (when, and longitude, latitude, metres above sea level), homes, the
/// three flight volumes, fence, audience and obstacles; show hash, certified mark, origin, limits and airspace as
/// ExtendedData. Linear from `when` to `when`. Lights but for one colour, yaw and payload events are lost. Refuses
/// shows without an origin or its geoid undulation. Reads other programs' KML and KMZ with gx:Track too (Track,
/// MultiTrack; altitudeMode absolute or relativeToGround): show time 0 is the earliest `when`, the origin the first
/// place of the first track. Errors: invalid_input with file and line.
[[nodiscard]] const Format& kmz_format();

/// Format::read of kmz_format().
Result<RecordedShow> read_kmz(std::span<const FileBytes> files);

/// The document without tracks, or with those given. @param tracks  placemarks. @param links  NetworkLink elements.
[[nodiscard]] std::string kml_document(const OutgoingShow& show, const Seal& seal, const Run& run,
                                       std::string_view tracks, std::string_view links);

}  // namespace aerogram::exporter
