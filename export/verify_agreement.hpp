#pragma once
#include <string>
#include <vector>

#include "export/certificate_json.hpp"
#include "export/manifest_json.hpp"
#include "export/record/recorded_show.hpp"
#include "geo/run.hpp"

/// Whether the files of one exported show tell the same story. Each function returns problems for people, without the
/// folder's name; empty: they agree.
namespace aerogram::exporter {

using Problems = std::vector<std::string>;

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

/// The certificate against the manifest, and each act's claims against what `trajectories` really do then: separation
/// and the pair that is closest, speeds, acceleration, jerk, altitudes, margins. A claim may be milder than the truth,
/// never better by more than rounding. (export/verify_certificate.cpp)
/// Errors: stopped; invalid_input when the trajectories are not well-formed.
Result<Problems> disagreement_with_certificate(const CertificateRecord& certificate, const Manifest& manifest,
                                               const RecordedShow& trajectories, const Run& run);

}  // namespace aerogram::exporter
