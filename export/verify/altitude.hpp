#pragma once
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "export/record/bezier.hpp"
#include "geo/show_frame.hpp"

namespace aerogram::exporter {

struct AltitudeRange {
    double low = 0.0, high = 0.0;
};

/// Height above a drone's own home. Near the origin the ellipsoid's curvature brackets it from x, y and z alone; where
/// that does not suffice one conversion bounds a whole piece, because the difference to show z changes by at most the
/// tilt of the vertical a metre.
class Altitude {
  public:
    Altitude(const std::optional<geo::ShowFrame>& frame, const Vec3& home_m)
        : frame_(frame ? &*frame : nullptr),
          home_m_(frame_ ? frame_->to_geodetic(home_m).height_m : home_m.z),
          ground_m_(frame_ ? frame_->origin().ground.height_m : 0.0) {}

    [[nodiscard]] double of(const Vec3& p) const { return (frame_ ? frame_->to_geodetic(p).height_m : p.z) - home_m_; }

    /// Without a conversion: wider than the truth by 2 % of what the earth curves away, 0.1 mm at 270 m.
    /// @param controls  of a Bézier curve.
    [[nodiscard]] AltitudeRange rough(std::span<const Vec3> controls) const {
        if (!frame_) return shifted(heights(controls), 0.0);
        if (!near_origin(controls)) return {-kAnything_m, kAnything_m};
        const Vec3& at = controls.front();  // r² is above its tangent plane there
        AltitudeRange range{kAnything_m, -kAnything_m};
        for (const Vec3& p : controls) {
            const double tangent_m2 = 2.0 * (p.x * at.x + p.y * at.y) - (at.x * at.x + at.y * at.y);
            range.low = std::min(range.low, p.z + std::max(0.0, tangent_m2) * kLeastSag);
            range.high = std::max(range.high, p.z + (p.x * p.x + p.y * p.y) * kMostSag);
        }
        return shifted({range.low - kRoundoff_m, range.high + kRoundoff_m}, ground_m_);
    }
    /// Exact up to the piece's length times the tilt.
    [[nodiscard]] AltitudeRange range(const Bezier& curve) const {
        if (!frame_) return shifted(heights(curve.controls()), 0.0);
        const Vec3 middle = 0.5 * (curve.front() + curve.back());
        double reach_m = 0.0, farthest_m = 0.0;
        for (const Vec3& p : curve.controls()) {
            reach_m = std::max(reach_m, glm::length(p - middle));
            farthest_m = std::max(farthest_m, std::hypot(p.x, p.y));
        }
        const double slack_m = std::min(2.0, farthest_m / kLeastCurvatureRadius_m) * reach_m;
        const AltitudeRange above = shifted(heights(curve.controls()), of(middle) + home_m_ - middle.z);
        return {above.low - slack_m, above.high + slack_m};
    }

  private:
    static constexpr double kLeastCurvatureRadius_m = 6.3e6;  ///< of WGS84, rounded down
    static constexpr double kAnything_m = 1e9;
    static constexpr double kRoundoff_m = 1e-8;  ///< of a conversion
    /// Along a line from the origin's vertical the height's second derivative is a normal curvature of WGS84 (radius
    /// 6335 to 6400 km) at the line's height, times the squared cosine of the vertical's tilt, less than 0.004 rad
    /// here.
    static constexpr double kNear_m = 20e3;
    static constexpr double kLeastSag = 0.5 / 6.43e6, kMostSag = 0.5 / 6.31e6;

    [[nodiscard]] bool near_origin(std::span<const Vec3> controls) const {
        for (const Vec3& p : controls) {
            if (p.x * p.x + p.y * p.y > kNear_m * kNear_m || std::abs(p.z) > 0.5 * kNear_m) return false;
        }
        return std::abs(ground_m_) <= 0.5 * kNear_m;
    }
    [[nodiscard]] AltitudeRange shifted(const AltitudeRange& range, double by_m) const {
        return {range.low + by_m - home_m_, range.high + by_m - home_m_};
    }
    [[nodiscard]] static AltitudeRange heights(std::span<const Vec3> controls) {
        AltitudeRange range{controls.front().z, controls.front().z};
        for (const Vec3& p : controls) range = {std::min(range.low, p.z), std::max(range.high, p.z)};
        return range;
    }

    const geo::ShowFrame* frame_;
    double home_m_;    ///< height of home; above the ellipsoid with a frame
    double ground_m_;  ///< of the origin
};

}  // namespace aerogram::exporter
