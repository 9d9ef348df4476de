#pragma once
#include <algorithm>
#include <cmath>
#include <optional>

#include "export/record/bezier.hpp"
#include "geo/show_frame.hpp"

namespace aerogram::exporter {

struct AltitudeRange {
    double low = 0.0, high = 0.0;
};

/// Height above a drone's own home. The difference to show z (the earth curves away) changes by at most the tilt of the
/// vertical a metre, so that one conversion bounds a whole piece.
class Altitude {
  public:
    Altitude(const std::optional<geo::ShowFrame>& frame, const Vec3& home_m)
        : frame_(frame ? &*frame : nullptr),
          home_m_(home_m),
          home_sag_m_(frame_ ? sag(std::hypot(home_m.x, home_m.y)) : 0.0) {}

    [[nodiscard]] double of(const Vec3& p) const {
        return frame_ ? frame_->altitude_above(home_m_, p) : p.z - home_m_.z;
    }
    /// Cheap and wide.
    [[nodiscard]] AltitudeRange rough(const Bezier& curve) const {
        AltitudeRange range = heights(curve);
        if (frame_) {
            range.low -= home_sag_m_;
            range.high += sag(farthest(curve));
        }
        return range;
    }
    /// Exact up to the piece's length times the tilt.
    [[nodiscard]] AltitudeRange range(const Bezier& curve) const {
        AltitudeRange range = heights(curve);
        if (!frame_) return range;
        const Vec3 middle = 0.5 * (curve.front() + curve.back());
        const double shift_m = of(middle) - (middle.z - home_m_.z);
        double reach_m = 0.0;
        for (const Vec3& p : curve.controls()) reach_m = std::max(reach_m, glm::length(p - middle));
        const double slack_m = std::min(2.0, farthest(curve) / kLeastCurvatureRadius_m) * reach_m;
        return {range.low + shift_m - slack_m, range.high + shift_m + slack_m};
    }

  private:
    static constexpr double kLeastCurvatureRadius_m = 6.3e6;  ///< of WGS84, rounded down

    static double sag(double horizontal_m) {
        return 1.05 * horizontal_m * horizontal_m / (2.0 * kLeastCurvatureRadius_m);
    }
    static double farthest(const Bezier& curve) {
        double most = 0.0;
        for (const Vec3& p : curve.controls()) most = std::max(most, std::hypot(p.x, p.y));
        return most;
    }
    [[nodiscard]] AltitudeRange heights(const Bezier& curve) const {
        AltitudeRange range{curve.front().z, curve.front().z};
        for (const Vec3& p : curve.controls()) range = {std::min(range.low, p.z), std::max(range.high, p.z)};
        return {range.low - home_m_.z, range.high - home_m_.z};
    }

    const geo::ShowFrame* frame_;
    Vec3 home_m_;
    double home_sag_m_;
};

}  // namespace aerogram::exporter
