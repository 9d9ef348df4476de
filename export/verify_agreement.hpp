#pragma once
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "export/bytes/file_bytes.hpp"
#include "export/certificate_json.hpp"
#include "export/manifest_json.hpp"
#include "export/record/recorded_show.hpp"
#include "geo/run.hpp"

/// Whether the files of one exported show tell the same story. Each function returns problems for people, without the
/// folder's name; empty: they agree.
namespace aerogram::exporter {

using Problems = std::vector<std::string>;

/// Files that nobody flies, beside the certificate: named as formats in the manifest, but no formats.
inline constexpr std::array<std::string_view, 2> kPapers{"report", "pads"};
[[nodiscard]] bool is_paper(std::string_view format);

/// Gives a show the manifest's limits, airspace, origin and endurance, and the pads where it states no places.
void complete_from(const Manifest& manifest, RecordedShow& show);

/// A format's show against what the manifest says: show hash, certified mark, drones with names and pads, stated
/// rounding; trajectories also in limits, airspace, origin, endurance and length; others in the origin they hold, to
/// its rounding (1e-7 degrees, 1 mm).
[[nodiscard]] Problems disagreement_with_manifest(const RecordedShow& show, const Manifest& manifest);

/// Two shows of one fleet: positions at evenly spread times (about 4 a second, fewer for large fleets) are within the
/// sum of both formats' rounding and fit. Of an untimed show, each waypoint is a place where the reference stops or
/// passes a knot.
/// @param reference  timed and well-formed, as many drones as `show`; its format's name appears in problems.
[[nodiscard]] Problems disagreement_of_shows(const RecordedShow& reference, const RecordedShow& show,
                                             const Limits& limits, const geo::ShowOrigin& origin);

/// Two shows' smallest separations, as judged: they differ by no more than rounding, fit and times of both allow.
[[nodiscard]] Problems disagreement_of_separations(const RecordedShow& reference, double reference_m,
                                                   const RecordedShow& show, double separation_m, const Limits& limits);

/// Lights of a format that keeps them against the exact plan's, where a lamp is steady; the first that differs.
[[nodiscard]] Problems disagreement_of_lights(const RecordedShow& reference, const RecordedShow& show);

/// A paper against the manifest: report.json's hash, certified mark, drones and smallest separation; the hash on
/// report.html; the names and places of pads.csv. PDFs have nothing that is read back.
[[nodiscard]] Problems disagreement_of_paper(const FileBytes& file, const Manifest& manifest);

/// The certificate against the manifest, and each act's claims against what `trajectories` really do then: separation
/// and the pair that is closest, speeds, acceleration, jerk, altitudes, margins. A claim may be milder than the truth,
/// never better by more than rounding. (export/verify_certificate.cpp)
/// Errors: stopped; invalid_input when the trajectories are not well-formed.
Result<Problems> disagreement_with_certificate(const CertificateRecord& certificate, const Manifest& manifest,
                                               const RecordedShow& trajectories, const Run& run);

}  // namespace aerogram::exporter
