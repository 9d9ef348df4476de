#pragma once
#include <array>
#include <vector>

#include "geo/run.hpp"
#include "geo/show_frame.hpp"
#include "planner/motion/act.hpp"

namespace aerogram::planner {

/// Heights above the ellipsoid, compared with those of other points nearby, without a geodetic conversion each: z plus
/// a quadratic form of (x, y), which is the ellipsoid's curvature at the show's origin.
class Heights {
  public:
    explicit Heights(const geo::ShowFrame& frame);

    /// Height of a point, up to a constant that is the same for all, metres.
    [[nodiscard]] double operator()(const Vec3& p) const { return p.z + bend_m(p); }
    [[nodiscard]] double bend_m(const Vec3& p) const { return p.x * (xx_ * p.x + xy_ * p.y) + yy_ * p.y * p.y; }
    /// xx, xy, yy of the form, 1/m.
    [[nodiscard]] std::array<double, 3> form() const { return {xx_, xy_, yy_}; }
    /// No difference of two heights is wrong by more than this, for points at most radius_m from the origin in (x, y)
    /// and height_m in z. What is left out: the ellipsoid's third order, at most its flattening times radius³ / R², the
    /// circle's fourth, radius⁴ / R³, and the tilt of the upright, height · radius² / R²; each is taken twice at least.
    [[nodiscard]] static double error_m(double radius_m, double height_m);

  private:
    double xx_ = 0.0, xy_ = 0.0, yy_ = 0.0;
};

/// Where each drone goes during an act.
struct Reaches {
    Points low_m, high_m;  ///< a box around the whole path
    /// Lowest and highest altitude above the own pad: of the segment of a straight act, of the Bézier control points of
    /// a lattice (whose curve may sag below the lowest of them by under a micrometre for pieces of metres).
    std::vector<double> altitude_low_m, altitude_high_m;
    double error_m = 0.0;  ///< of the altitudes

    /// Whether drone i never leaves the upright through a place.
    [[nodiscard]] bool stays_over(std::size_t i, const Vec3& place_m, double tolerance_m) const;
    [[nodiscard]] bool moves_sideways(std::size_t i, double tolerance_m) const;
};
/// One look at the whole act. Unfinished when a stop was asked for.
/// @param pads_m  one a drone.
/// Accuracy: altitudes within error_m of the exact ones, which is below 1e-4 m whatever the show's size.
/// Cost: 3 ns a drone and knot interval up to 3 km around the origin, a geodetic conversion for each point beyond.
[[nodiscard]] Reaches reaches(const Motion& motion, const geo::ShowFrame& frame, const Points& pads_m, const Run& run);

}  // namespace aerogram::planner
