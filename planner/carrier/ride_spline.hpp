#pragma once
#include <span>
#include <vector>

#include "planner/motion/act.hpp"

namespace aerogram::planner {

/// The lattice through samples at its knots whose acceleration is 0 at both ends, at whatever velocity (the natural
/// spline); lattice_through is its sibling at rest.
/// @param samples_m  rows of `drones` positions, one row a knot; >= 3 rows.
/// Properties: (1) every sample is met to 1e-12 of the coordinates (2) samples on a line at constant steps give a
/// constant velocity. O(rows x drones).
[[nodiscard]] Lattice gliding_lattice_through(std::span<const Vec3> samples_m, std::size_t drones);

/// Rows [first_knot, last_knot + 3) of a lattice: its part between two knots.
[[nodiscard]] Lattice part_of(const Lattice& lattice, std::size_t first_knot, std::size_t last_knot);

}  // namespace aerogram::planner
