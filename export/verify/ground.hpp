#pragma once
#include <vector>

#include "export/record/recorded_show.hpp"

namespace aerogram::exporter {

/// Show time from begin_s to end_s; infinite where a drone stands before its first or after its last piece.
struct Interval {
    double begin_s = 0.0, end_s = 0.0;
    bool operator==(const Interval&) const = default;
};

/// How far from its home or landing place a drone may be and still stand on the ground: vertically, and horizontally,
/// metres.
inline constexpr double kOnGround_m = 0.05;

/// When a drone certainly stands on the ground: its whole curve is within kOnGround_m, vertically and horizontally, of
/// its home, or the whole is within it of its landing place. Without a home the first position counts, without a
/// landing place the last. Conservative: of a piece that only partly stands, just a beginning or an end is found (to a
/// thousandth of the piece); standing in the middle of a piece counts as flying.
/// @returns intervals in time order, apart from each other.
[[nodiscard]] std::vector<Interval> grounded_intervals(const RecordedDrone& drone);

}  // namespace aerogram::exporter
