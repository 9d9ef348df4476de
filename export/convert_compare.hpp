#pragma once
#include <optional>
#include <string>
#include <vector>

#include "export/outgoing/outgoing_show.hpp"
#include "export/record/recorded_show.hpp"
#include "geo/result.hpp"
#include "geo/run.hpp"

/// What a show became when it was written in another format: measured on what is read back, not promised.
namespace aerogram::exporter {

/// How far a drone may be from where it was.
struct Deviation {
    double position_m = 0.0;  ///< upper bound at every instant, over all drones
    std::size_t drone = 0;    ///< its place among the drones
    double time_s = 0.0;
};

/// Bounds the distance between the flights that went out and the pieces that came back, by the control polygons of
/// their difference wherever each is one polynomial.
/// @param read  timed and well-formed, as many drones.
/// Properties: (1) never below a dense sampling's largest distance (2) the same flights give 0 to 1e-9 m.
Result<Deviation> deviation(const OutgoingShow& show, const RecordedShow& read, const Run& run);

/// What the format states that a position may be off by: rounding, fit, and what the fastest drone flies in the
/// rounding of times; 1e-6 m for arithmetic.
[[nodiscard]] double stated_accuracy_m(const OutgoingShow& show, const RecordedShow& read);

/// What the show had and the file has not, for people: only what was there is named.
/// @param origin_held  what IN itself said, before anything was added on the way out.
/// @param stated  Format::lost: parts of it that speak of nothing measured here are passed on.
[[nodiscard]] std::vector<std::string> losses(const OutgoingShow& show, const RecordedShow& given,
                                              const RecordedShow& read, std::string_view stated);

}  // namespace aerogram::exporter
