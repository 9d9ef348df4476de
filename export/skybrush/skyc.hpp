#pragma once
#include "export/outgoing/format.hpp"

/// `show.skyc`: a Skybrush compiled show (FORMATS.md 1, docs/formats/skyc.md). A fleet of more than kSkycDrones leaves
/// as `show-1.skyc`, `show-2.skyc`, ... of near-equal size in drone order, with one origin, clock and show hash.
namespace aerogram::exporter {

inline constexpr std::size_t kSkycDrones = 5000;  ///< in one file

/// Stated accuracy of the curve writer: 3 decimals, and a refit within fit_bound (export/outgoing/curve_fit.hpp), or
/// the plan is refused. On a Bézier piece of T seconds a control point that is off by e a component moves velocity by 2
/// d e / T and acceleration by 4 d (d - 1) e / T² a component (d the degree), vectors by √3 times that; the reader adds
/// the largest of these over the file's own pieces to the refit's share.
///
/// Writes show.json, cues.json, drones/<name>/trajectory.json and lights.json joined by $ref, and the show's music
/// (skyc_audio.hpp); X front, Y left, Z up; the orientation is the heading of our +y. The location is AMSL: without a
/// geoid undulation it is left out and the title says so. Yaw goes out in degrees clockwise from +X; payload events
/// that switch on go out as pyro events, those that switch off are lost. The title of an uncertified show begins with
/// "UNCERTIFIED "; meta.id is the show hash; meta.aerogram holds what the format has no place for: airspace, endurance,
/// certified mark, some limits.
[[nodiscard]] const Format& skyc_format();

/// Format::read of skyc_format(). Reads other programs' shows (docs/formats/skyc.md): values inline or by $ref (any
/// depth up to 16, local or in another .json of the archive), linear to cubic pieces, missing optional parts, a
/// geofence; versions must be 1. Several files must be successive parts of one show; one part alone is read as the
/// drones it holds. Errors: invalid_input naming archive, entry and key.
Result<RecordedShow> read_skyc(std::span<const FileBytes> files);

/// What the format adds to titles; the reader takes it off again.
inline constexpr std::string_view kUncertifiedTitle = "UNCERTIFIED ";
inline constexpr std::string_view kNoLocationTitle = " (no location: geoid undulation not known)";

}  // namespace aerogram::exporter
