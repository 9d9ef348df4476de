#pragma once
#include <array>
#include <cstddef>
#include <string_view>

#include "geo/vec3.hpp"

namespace aerogram::study {

/// The formations' spacing of every instance, m: no two drones of either formation are closer (1e-9 allowed).
inline constexpr double kSpacing_m = 2.2;

/// Two formations of as many drones; who flies where is open.
struct Instance {
    Points from_m, to_m;
};

/// grid-letters: pads on the ground to filled, upright letters; sheet-sphere and sheet-ring: an upright sheet to a
/// sphere and to a flat, tilted ring of circles; random: two boxes of scattered drones.
inline constexpr std::array<std::string_view, 4> kInstances{"grid-letters", "sheet-sphere", "sheet-ring", "random"};

/// The named instance with n >= 2 drones: always the same. Throws std::invalid_argument for another name.
Instance make_instance(std::string_view name, std::size_t n);

/// The smallest distance between two of the points (Euclidean), m.
double smallest_spacing_m(const Points& points_m);

}  // namespace aerogram::study
