#pragma once
#include <string>
#include <string_view>

#include "export/outgoing/format.hpp"
#include "export/record/recorded_show.hpp"
#include "planner/motion/flight_plan.hpp"

/// trajectories.bin, the exact plan: docs/formats/trajectories-bin.md.
namespace aerogram::exporter {

/// Rows of a straight act's profile: a file with more is refused, so that reading stays within 1,000 times its bytes.
inline constexpr std::size_t kMaxProfileRows = 256;

/// The payload. @param scalar_bytes  8: exact; 4: rounded to floats, for the preview.
/// @param plan  one for which trajectories_unsuited() is empty.
/// Properties: (1) the same plan, the same bytes (2) any change of what the payload holds changes the bytes.
std::string trajectories_payload(const planner::FlightPlan& plan, int scalar_bytes);

/// Header and payload: the bytes of the file.
std::string trajectories_bytes(const planner::FlightPlan& plan, const Seal& seal, int scalar_bytes);

/// Why the plan cannot be written ("longer than 24 days"), or empty.
std::string trajectories_unsuited(const planner::FlightPlan& plan);

/// Why a show cannot leave in a format that holds plans: it is none, or trajectories_unsuited; or empty.
std::string not_a_whole_plan(const OutgoingShow& show);

/// Reads either width. Each knot interval becomes one cubic piece, a hold one piece of degree 0.
/// Properties: (1) any changed byte is an error, except in the show hash of a 4-byte file together with the header's
/// CRC (2) never reads outside the bytes; memory is at most about 1,000 times theirs. Errors: invalid_input naming the
/// offset: damaged, cut short, trailing bytes, another version, a number that is not finite or out of range, times that
/// run backwards, a payload that does not have the hash the header states.
Result<RecordedShow> read_trajectories(std::string_view bytes);

const Format& trajectories_format();

}  // namespace aerogram::exporter
