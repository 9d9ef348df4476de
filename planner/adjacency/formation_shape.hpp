#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geo/vec3.hpp"

namespace aerogram::planner {

/// Points nearer to each other than this share of the formation's radius are one place.
inline constexpr double kCoincidentShare = 1e-6;
/// A formation is flat (straight) when nobody is farther from its best plane (line) than this share of the spacing:
/// then two points a spacing apart keep at least √(1 - ½²) = 0.87 of their distance in the projection, so nobody lands
/// on a neighbour, and what is beyond the plane is too thin to hold a second layer.
inline constexpr double kFlatShare = 0.25;

/// How a set of points lies in space.
struct FormationShape {
    int dimension = 0;           ///< 0 one place, 1 a row, 2 a plane, 3 solid
    double spacing_m = 0.0;      ///< median distance to the nearest other place; 0 when there is none
    double radius_m = 0.0;       ///< largest distance from the barycentre
    double thickness_m = 0.0;    ///< largest distance from the best plane
    Vec3 center_m{};             ///< barycentre
    std::array<Vec3, 3> axes{};  ///< orthonormal principal axes, widest first
};

/// The shape of distinct points by principal component analysis; rigid motions only turn the axes.
/// @param places_m  n >= 1 finite points, pairwise distinct.
FormationShape shape_of(std::span<const Vec3> places_m);

/// For each point the lowest index that is at the same place (kCoincidentShare, transitively); its own index if it
/// comes first.
std::vector<std::uint32_t> same_place(std::span<const Vec3> points_m);

}  // namespace aerogram::planner
