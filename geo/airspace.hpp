#pragma once
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "geo/vec3.hpp"

namespace aerogram::geo {

/// A simple polygon on the ground, show frame x-y, metres; either orientation, closed implicitly.
using Polygon = std::vector<Vec2>;

/// Upright solids standing on z = base_m (show frame).
struct Cylinder {
    Vec2 center_m{};
    double radius_m = 0.0;
};
struct Prism {
    Polygon outline_m;
};
struct Obstacle {
    std::string name;
    std::variant<Cylinder, Prism> shape;  ///< a box is a prism of four corners
    double base_m = 0.0;
    double height_m = 0.0;
};

/// Where a show may fly, in the show frame.
struct Airspace {
    Polygon geofence_m;               ///< empty: no fence; else nobody may leave it
    std::vector<Polygon> audience_m;  ///< nobody may be over any of these
    std::vector<Obstacle> obstacles;
};

/// Signed distance to a polygon's edge, metres: positive inside, negative outside; 1-Lipschitz. @param polygon >= 3 vertices.
[[nodiscard]] double signed_distance(const Polygon& polygon, const Vec2& p);
/// Distance to an obstacle, metres: positive outside, negative inside; 1-Lipschitz.
[[nodiscard]] double clearance(const Obstacle& obstacle, const Vec3& p);
/// True when no two edges cross or touch except neighbours at their shared vertex, and the area is not 0.
[[nodiscard]] bool is_simple(const Polygon& polygon);

}  // namespace aerogram::geo
