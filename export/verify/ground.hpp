#pragma once
#include <array>
#include <cstdint>
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
/// How far beside its home or landing place a drone may be, horizontally, and still be straight above it; what the
/// file's rounding and fit may move a point on the ground plane is added.
inline constexpr double kStraightAbove_m = 0.01;

/// Drones with places closer to each other than this in plan view, metres, are never excused: there is no room for two.
/// It is the least distance of pads in a mission.
inline constexpr double kClosestPads_m = 0.2;

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

/// When a drone certainly is straight above its home place, or above its landing place: its whole curve is within
/// `beside_m` of it horizontally and not lower than kOnGround_m below it. As conservative as grounded_intervals.
[[nodiscard]] std::vector<Interval> upright_intervals(const RecordedDrone& drone, double beside_m);

/// What counts for separation: a pair is excused while one of the two stands on its own pad and the other stands on, or
/// is straight above, its own. Where pads are as far apart as drones must be, such a pair keeps its distance anyway,
/// but for kStraightAbove_m; on tighter pads it is how drones start and land in layers. Whoever comes sideways is
/// above no pad of its own and is not excused. Pads that are too_close excuse nobody.
enum class Stance : std::uint8_t { flying, above_pad, on_pad };
[[nodiscard]] constexpr bool excused(Stance a, Stance b) {
    return (a == Stance::on_pad && b != Stance::flying) || (b == Stance::on_pad && a != Stance::flying);
}

/// A drone's home and landing place, where it has them.
using Places = std::array<std::optional<Vec3>, 2>;
[[nodiscard]] Places places_of(const RecordedDrone& drone);
/// Whether a place of one is less than `least_m` from one of the other in plan view.
[[nodiscard]] bool too_close(const Places& a, const Places& b, double least_m);

/// An interval in which a drone is not flying freely.
struct Stay {
    double begin_s = 0.0, end_s = 0.0;
    Stance stance = Stance::flying;
};
/// Grounded intervals, and upright ones where they are not grounded; in time order, apart or touching.
[[nodiscard]] std::vector<Stay> stays(const RecordedDrone& drone, double beside_m);

}  // namespace aerogram::exporter
