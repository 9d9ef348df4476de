#pragma once
#include <optional>
#include <string>
#include <vector>

#include "export/verify/judge.hpp"
#include "export/verify/worst.hpp"
#include "geo/show_frame.hpp"

/// The rules of a show, one family a source file; each returns its findings. Shows are well-formed.
namespace aerogram::exporter {

/// Numbers this close count as equal: the verifier's own arithmetic, SI units. No allowance of a file.
inline constexpr double kNumeric = 1e-6;
/// Altitudes are judged to this on top of a file's rounding: over a straight chord between two points at a limit the
/// earth's curve moves the height above home by up to a millimetre, which no vehicle flies to.
inline constexpr double kAltitude_m = 1e-3;

struct Rules {
    Limits limits;
    geo::Airspace airspace;
    std::optional<geo::ShowFrame> frame;  ///< absent: altitudes are differences of show z
    std::optional<double> endurance_s;
    Rounding rounding;

    /// What rounding and fit may move a point, metres: along one axis, on the ground plane, in space.
    [[nodiscard]] double axis_m() const { return rounding.position_m + rounding.fit_m; }
    [[nodiscard]] double plane_m() const { return std::sqrt(2.0) * rounding.position_m + rounding.fit_m; }
    [[nodiscard]] double space_m() const { return std::sqrt(3.0) * rounding.position_m + rounding.fit_m; }
};

/// A finding that must not exceed limit + allowance, from the minimum of its negative; empty when nothing was seen.
[[nodiscard]] std::vector<Finding> at_most(std::string rule, double limit, double allowance,
                                           const FleetWorst& negative);
/// A finding that must not fall below limit - allowance.
[[nodiscard]] std::vector<Finding> at_least(std::string rule, double limit, double allowance,
                                            const FleetWorst& smallest);

/// speed_horizontal, speed_up, speed_down; acceleration and velocity_jump (m/s, where pieces meet, and at the show's
/// two ends where a drone must be at rest); position_jump.
[[nodiscard]] std::vector<Finding> motion_findings(const RecordedShow& show, const Rules& rules, const Run& run);
/// altitude_max; altitude_min: the lowest altitude, nobody flies below the ground; altitude_min_navigation: the
/// horizontal way, metres, flown in one stay below the lowest altitude at which horizontal motion is allowed.
[[nodiscard]] std::vector<Finding> altitude_findings(const RecordedShow& show, const Rules& rules, const Run& run);
/// geofence, audience, obstacles: smallest margins, metres, each where the airspace has any.
[[nodiscard]] std::vector<Finding> airspace_findings(const RecordedShow& show, const Rules& rules, const Run& run);
/// pads: distance of the first position from home and of the last from the landing place, where the file holds them;
/// endurance: the show's length, where an endurance is known.
[[nodiscard]] std::vector<Finding> ground_findings(const RecordedShow& show, const Rules& rules);
/// Tracks out of order, colours out of range, a length that the pieces do not have; for people.
[[nodiscard]] std::vector<std::string> track_problems(const RecordedShow& show);

/// From where a drone's altitudes count: its home, where none is stated z = 0 under its first position.
[[nodiscard]] inline Vec3 home_of(const RecordedDrone& drone) {
    const Vec3 first = first_position(drone);
    return drone.home_m.value_or(Vec3{first.x, first.y, 0.0});
}

}  // namespace aerogram::exporter
