#pragma once
#include <array>
#include <span>
#include <vector>

#include "geo/vec3.hpp"

namespace aerogram::planner {

/// Where somebody is within a formation, whatever its place and size (paper 002, section 3.3): the distance from its
/// centre over the formation's radius there, in [0, 1], and the direction from the centre, a unit vector (zero in the
/// centre itself): along the reference direction, across it, and (flat: 0) out of the plane.
using FormationCoordinate = std::array<double, 4>;

/// What a formation's coordinates are measured by: its centre and its radii along some directions. The paper draws a
/// radius to where its direction meets the boundary; here it is the distance of the farthest point among those that
/// are nearer to this direction than to another, so that clouds without boundary have radii too and nobody's distance
/// is above 1.
struct PlaneFrame {
    Vec2 center{};
    Vec2 reference{1.0, 0.0};         ///< unit; directions are told from here
    std::array<Vec2, 8> direction{};  ///< both principal axes and their diagonals
    std::array<double, 8> radius{};
};
struct SpaceFrame {
    Vec3 center{};
    Vec2 reference{1.0, 0.0};     ///< unit; across the ground
    std::vector<Vec3> direction;  ///< 26: three principal axes, their diagonals in pairs and all together; flat: its 8
    std::vector<double> radius;   ///< one a direction
};

/// @param points  n >= 1. @param weights  for the centre and the axes: empty (alike), or one >= 0 a point with a
/// positive sum.
/// @param reference_rad  how far the reference direction is turned, counter-clockwise: a formation that turns with its
/// group's course keeps its coordinates (section 3.3, feature 1).
/// Properties: (1) coordinates of the points have distances in [0, 1] (2) moving and enlarging the points leaves their
/// coordinates (3) turning them and the reference alike too, where the spreads along the axes differ.
[[nodiscard]] PlaneFrame plane_frame(std::span<const Vec2> points, std::span<const double> weights = {},
                                     double reference_rad = 0.0);
[[nodiscard]] FormationCoordinate coordinate_in(const PlaneFrame& frame, const Vec2& point);

/// The same in space, with 26 radii. The reference is turned about the vertical. Points within 0.02 of their largest
/// spread of a plane are flat, and have the eight radii of their plane.
[[nodiscard]] SpaceFrame space_frame(std::span<const Vec3> points, std::span<const double> weights = {},
                                     double reference_rad = 0.0);
[[nodiscard]] FormationCoordinate coordinate_in(const SpaceFrame& frame, const Vec3& point);

/// The coordinates of several points.
[[nodiscard]] std::vector<FormationCoordinate> coordinates_in(const PlaneFrame& frame, std::span<const Vec2> points);
[[nodiscard]] std::vector<FormationCoordinate> coordinates_in(const SpaceFrame& frame, std::span<const Vec3> points);

/// A flat formation's plane, as its audience would draw it: right is towards +x, up towards +z, on the ground away
/// from the audience (+y). Absent components: not flat.
struct DrawingPlane {
    Vec3 center{}, right{1, 0, 0}, up{0, 0, 1};

    [[nodiscard]] Vec2 seen(const Vec3& p) const { return {glm::dot(p - center, right), glm::dot(p - center, up)}; }
};
/// @param points  n >= 1. @param plane  filled when they are flat. @returns whether they are.
[[nodiscard]] bool is_flat(std::span<const Vec3> points, DrawingPlane& plane);

}  // namespace aerogram::planner
