#pragma once
#include <vector>

#include "geo/limits.hpp"
#include "geo/result.hpp"
#include "geo/vec3.hpp"
#include "planner/mission/mission.hpp"

namespace aerogram::planner {

/// The route of a carrier with its corners rounded. Seen from above: straight lines, and at each waypoint between them
/// a turn whose curvature rises and falls smoothly along the way (a circle between them where the turn is long; where
/// formations turn too, twice as wide and entered over at least three seconds). Height: the slope between two waypoints
/// is constant and changes smoothly about the middles of the turns. At the carrier's speed a turn takes half of the
/// acceleration, jerk and, of planes, turn rate allowed, a change of slope a quarter; the rest is left to the
/// formations. Ways are measured over the ground.
class CarrierPath {
  public:
    /// Errors: infeasible at the mission's [carrier] when a waypoint turns back on itself or the lines beside it are
    /// too short for the turn, naming waypoints and lengths.
    static Result<CarrierPath> through(const Mission& mission);

    [[nodiscard]] double length_m() const;
    /// Where the path is after s_m metres (clamped to its ends).
    /// Properties: (1) the first and last waypoints are its ends (2) seen from above |d/ds| = 1, and the curvature is
    /// continuous and within what the limits allow (3) the slope is continuous and nowhere outside those of the lines.
    /// Accuracy: 1e-9 m.
    [[nodiscard]] Vec3 at(double s_m) const;
    /// Direction of travel seen from above, a unit vector.
    [[nodiscard]] Vec2 direction(double s_m) const;
    /// Yaw of the direction of travel, counter-clockwise from +y seen from above, radians in (-pi, pi].
    [[nodiscard]] double yaw_rad(double s_m) const;

  private:
    /// Curvature goes from one end to the other as u²(3 - 2u).
    struct Piece {
        double begin_m = 0.0, length_m = 0.0;
        Vec2 from_m{};
        double heading_rad = 0.0;                           ///< counter-clockwise from +x
        double curvature_begin = 0.0, curvature_end = 0.0;  ///< 1/m, positive to the left

        [[nodiscard]] double heading_at(double s_m) const;
        [[nodiscard]] Vec2 at(double s_m) const;
    };
    struct Turn;  ///< how one waypoint is rounded
    /// Heights: lines between bends; about each the slope changes within half_m on either side.
    struct Slope {
        double at_m = 0.0, z_m = 0.0, half_m = 0.0;
    };

    void add(double length_m, double curvature_begin, double curvature_end);
    [[nodiscard]] const Piece& piece_at(double s_m) const;
    [[nodiscard]] double slope_after(std::size_t bend) const;
    [[nodiscard]] double height_at(double s_m) const;
    [[nodiscard]] Status round_slopes(const Mission& mission);

    Vec2 end_m_{};  ///< while it is being built
    double heading_rad_ = 0.0;
    std::vector<Piece> pieces_;
    std::vector<Slope> slopes_;  ///< one a waypoint
};

}  // namespace aerogram::planner
