#pragma once
#include <optional>
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

/// Where a drone may stand. What is not stated is the point of z = 0, the ground of a show without pads, under the
/// first (the last) position, provided that is within kOnGround_m of it; absent otherwise: who hovers there is not
/// excused.
[[nodiscard]] std::optional<Vec3> home_place(const RecordedDrone& drone);
[[nodiscard]] std::optional<Vec3> landing_place(const RecordedDrone& drone);

/// When a drone certainly stands on the ground: its whole curve is within kOnGround_m, vertically and horizontally, of
/// its home place, or the whole is within it of its landing place. Conservative: of a piece that only partly stands,
/// just a beginning or an end is found (to a thousandth of the piece); standing in the middle of a piece counts as
/// flying.
/// @returns intervals in time order, apart from each other.
[[nodiscard]] std::vector<Interval> grounded_intervals(const RecordedDrone& drone);

}  // namespace aerogram::exporter
