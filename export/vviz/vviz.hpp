#pragma once
#include "export/outgoing/format.hpp"

/// `show.vviz`: the JSON that Verge Aero's and Finale 3D's programs, Depence and FWsim exchange (FORMATS.md 4,
/// docs/formats/vviz.md).
namespace aerogram::exporter {

/// What straight lines and rounding may cost two drones together, metres, or the export margin, if smaller.
inline constexpr double kVvizPairCost_m = 0.05;
/// Colours change at this rate: every key of ours falls on a frame.
inline constexpr Millis kVvizFrame_ms = 20;

/// How close the straight lines of a file follow the flights.
struct VvizFit {
    Millis step_ms = 0;        ///< flights are sampled this often...
    double tolerance_m = 0.0;  ///< ...and samples left out that lie this close to the line through the others
};
/// The largest step of 250, 200, 125, 100, 50, 40, 25, 20, 10 ms whose chords (a dt² / 8, a the show's largest
/// acceleration) take a fifth of what the pair cost leaves each drone after rounding; the rest is the tolerance. Absent
/// when none does.
[[nodiscard]] std::optional<VvizFit> vviz_fit(const OutgoingFacts& facts);

/// Writes places to the millimetre, each step from the rounded place before, so that nothing adds up; X right, Y up, Z
/// forward (verge) or backward (finale), as the show wishes; colours held to 20 ms; our facts under the key "aerogram",
/// which other programs pass over. Streams: memory is some hundred drones' text.
/// Reads other programs' files too: members in any order, unknown ones, missing dt and frames, several payloads;
/// without our key Z is taken as forward. Errors: invalid_input with file, drone and byte.
[[nodiscard]] const Format& vviz_format();

}  // namespace aerogram::exporter
