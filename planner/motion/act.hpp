#pragma once
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "geo/ids.hpp"
#include "geo/tracks.hpp"
#include "geo/vec3.hpp"

/// Acts: the pieces a plan is made of (DESIGN.md 3).
///
/// A moving act is a uniform cubic B-spline with one knot step h for all drones. Rows k = 0..K-1 of control points give
/// K-3 knot intervals; on interval m = 0..K-4 the curve is the cubic of rows m..m+3. Then exactly:
/// velocity control points are ΔP/h, acceleration is piecewise linear with vertices Δ²P/h², jerk is Δ³P/h³.
/// An act begins and ends at rest, its first three rows repeat, and its last three; unless it is part of a ride (a show
/// on a moving carrier), whose acts join in motion.
namespace aerogram::planner {

struct Hold {
    Points positions_m;  ///< one a drone
};
/// The fleet on straight lines with one scalar profile: P[k][i] = from[i] + profile[k] (to[i] - from[i]).
struct Straight {
    Points from_m, to_m;
    std::vector<double> profile;  ///< K >= 7 values, first three 0, last three 1, not decreasing
};
struct Lattice {
    std::size_t drones = 0;
    Points points_m;  ///< K rows of `drones` control points: points_m[k * drones + i]

    [[nodiscard]] std::size_t rows() const { return drones == 0 ? 0 : points_m.size() / drones; }
    [[nodiscard]] const Vec3& at(std::size_t row, std::size_t drone) const { return points_m[row * drones + drone]; }
    [[nodiscard]] Vec3& at(std::size_t row, std::size_t drone) { return points_m[row * drones + drone]; }
};
using Motion = std::variant<Hold, Straight, Lattice>;

enum class ActRole { takeoff, transit, hold, landing };
/// free: h is the shortest legal step, found after the geometry. fixed: h is given first, limits then accept or refuse.
enum class Timing { free, fixed };

struct Act {
    std::string name;  ///< "take-off", "to T", "T", "return", "landing"
    ActRole role = ActRole::hold;
    Timing timing = Timing::free;
    Millis start_ms = 0;
    Millis duration_ms = 0;  ///< > 0; h = duration / interval_count
    Motion motion;

    [[nodiscard]] Millis end_ms() const { return start_ms + duration_ms; }
};

[[nodiscard]] std::size_t drone_count(const Motion& motion);
/// Knot intervals: K - 3; 1 for a hold.
[[nodiscard]] std::size_t interval_count(const Motion& motion);
/// Knot step h, seconds.
[[nodiscard]] double knot_step_s(const Act& act);

/// Control point of a drone's row; a hold has one row repeated.
[[nodiscard]] Vec3 control_point(const Motion& motion, std::size_t row, std::size_t drone);
/// The cubic Bézier of one drone on one knot interval, exact.
[[nodiscard]] std::array<Vec3, 4> bezier(const Motion& motion, std::size_t interval, std::size_t drone);

struct Kinematics {
    Vec3 position_m{}, velocity_mps{}, acceleration_mps2{};
};
/// One drone at local time t_s in [0, duration] (clamped).
[[nodiscard]] Kinematics kinematics(const Act& act, DroneId drone, double local_t_s);
/// All positions at local time t_s (clamped). @param out  drone_count places.
void positions(const Act& act, double local_t_s, std::span<Vec3> out);
/// Where the curves begin and end: the control point itself where three rows are equal (at rest), else their
/// knot_value.
[[nodiscard]] Points start_positions(const Motion& motion);
[[nodiscard]] Points end_positions(const Motion& motion);

/// The curve's value at knot m from rows m, m+1, m+2: (P0 + 4 P1 + P2) / 6.
[[nodiscard]] inline Vec3 knot_value(const Vec3& p0, const Vec3& p1, const Vec3& p2) {
    return (p0 + 4.0 * p1 + p2) / 6.0;
}

/// The lattice at rest at both ends that passes through the samples at its knots. Knot 1 and the last but one are free
/// (rest at the ends takes their two conditions); all others are met to rounding error.
/// @param samples_m  (K-2) rows of `drones` positions, row m = position at knot m; first and last rows are the ends. K
/// >= 9. Accuracy: 1e-12 of the coordinates; O(K n). One tridiagonal factorisation for all drones.
[[nodiscard]] Lattice lattice_through(std::span<const Vec3> samples_m, std::size_t drones);

}  // namespace aerogram::planner
