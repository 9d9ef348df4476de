#pragma once
#include <vector>

#include "export/verify/claims.hpp"
#include "export/verify/rules.hpp"

/// What planes must hold, from the file's curves alone; airspeed is the speed over the ground, climb included.
namespace aerogram::exporter {

/// airspeed_min, airspeed_max, climb, sink, m/s; turn_rate_dps, degrees a second seen from above, where the format has
/// accelerations. Empty unless the limits are those of planes. A chord between two rows of a linear format is shorter
/// than the flown way: airspeed_min allows for that.
/// Accuracy: 1e-6 m/s, 1e-4 degrees a second, never on the lenient side.
[[nodiscard]] std::vector<Finding> plane_findings(const RecordedShow& show, const Rules& rules, const Run& run);

/// The claims of airspeed and turn rate that do not hold, as broken_claims tells the others.
[[nodiscard]] std::vector<BrokenClaim> broken_plane_claims(const RecordedShow& show, const Rules& rules,
                                                           const Claims& claims, const Run& run);

}  // namespace aerogram::exporter
