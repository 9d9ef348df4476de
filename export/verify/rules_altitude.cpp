#include "export/verify/rules.hpp"

namespace aerogram::exporter {
namespace {

constexpr double kLeastCurvatureRadius_m = 6.3e6;  ///< of WGS84, rounded down
constexpr double kShortest_s = 1e-5;               ///< a crossing of an altitude is found this exactly

struct Range {
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
    [[nodiscard]] Range rough(const Bezier& curve) const {
        Range range = heights(curve);
        if (frame_) {
            range.low -= home_sag_m_;
            range.high += sag(farthest(curve));
        }
        return range;
    }
    /// Exact up to the piece's length times the tilt.
    [[nodiscard]] Range range(const Bezier& curve) const {
        Range range = heights(curve);
        if (!frame_) return range;
        const Vec3 middle = 0.5 * (curve.front() + curve.back());
        const double shift_m = of(middle) - (middle.z - home_m_.z);
        double reach_m = 0.0;
        for (const Vec3& p : curve.controls()) reach_m = std::max(reach_m, glm::length(p - middle));
        const double slack_m = std::min(2.0, farthest(curve) / kLeastCurvatureRadius_m) * reach_m;
        return {range.low + shift_m - slack_m, range.high + shift_m + slack_m};
    }

  private:
    static double sag(double horizontal_m) {
        return 1.05 * horizontal_m * horizontal_m / (2.0 * kLeastCurvatureRadius_m);
    }
    static double farthest(const Bezier& curve) {
        double most = 0.0;
        for (const Vec3& p : curve.controls()) most = std::max(most, std::hypot(p.x, p.y));
        return most;
    }
    [[nodiscard]] Range heights(const Bezier& curve) const {
        Range range{curve.front().z, curve.front().z};
        for (const Vec3& p : curve.controls()) range = {std::min(range.low, p.z), std::max(range.high, p.z)};
        return {range.low - home_m_.z, range.high - home_m_.z};
    }

    const geo::ShowFrame* frame_;
    Vec3 home_m_;
    double home_sag_m_;
};

/// Follows one drone and measures how far it gets, horizontally, from where each stay below a threshold began.
class LowStays {
  public:
    LowStays(const Altitude& altitude, double threshold_m, Worst& negative)
        : altitude_(altitude), threshold_m_(threshold_m), negative_(negative) {}

    void visit(const Timed& on) {
        if (altitude_.rough(on.curve).low >= threshold_m_) {
            anchor_.reset();
            return;
        }
        const Range range = altitude_.range(on.curve);
        if (range.low >= threshold_m_) {
            anchor_.reset();
        } else if (range.high < threshold_m_ || on.end_s - on.begin_s < kShortest_s || upright(on.curve)) {
            stay(on);
            if (range.high >= threshold_m_ && altitude_.of(on.curve.back()) >= threshold_m_) anchor_.reset();
        } else {
            const auto [left, right] = split(on.curve, 0.5);
            const double middle_s = 0.5 * (on.begin_s + on.end_s);
            visit({left, on.begin_s, middle_s});
            visit({right, middle_s, on.end_s});
        }
    }

  private:
    static bool upright(const Bezier& curve) {
        return std::ranges::all_of(curve.controls(),
                                   [&](const Vec3& p) { return p.x == curve.front().x && p.y == curve.front().y; });
    }
    void stay(const Timed& on) {
        if (!anchor_) anchor_ = on.curve.front();
        for (const Vec3& p : on.curve.controls())
            negative_.meet(-std::hypot(p.x - anchor_->x, p.y - anchor_->y), on.end_s);
    }

    const Altitude& altitude_;
    double threshold_m_;
    Worst& negative_;
    std::optional<Vec3> anchor_;
};

}  // namespace

std::vector<Finding> altitude_findings(const RecordedShow& show, const Rules& rules, const Run& run) {
    const FleetWorst highest =
        worst_of_fleet(show.drones, run, "verifying altitudes", [&](const RecordedDrone& drone, Worst& worst) {
            const Altitude altitude(rules.frame, home_of(drone));
            const auto of = [&](const Vec3& p) { return -altitude.of(p); };
            const auto bound = [&](const Bezier& curve) {
                const double rough = -altitude.rough(curve).high;
                return rough >= worst.bound ? rough : -altitude.range(curve).high;
            };
            for_each_piece(drone, [&](const Timed& on) { minimise(on, Tolerance{}, of, bound, worst); });
        });
    const double threshold_m = rules.limits.min_navigation_altitude_m - rules.axis_m() - kNumeric;
    const FleetWorst low =
        worst_of_fleet(show.drones, run, "verifying low flight", [&](const RecordedDrone& drone, Worst& worst) {
            const Altitude altitude(rules.frame, home_of(drone));
            LowStays stays(altitude, threshold_m, worst);
            for_each_piece(drone, [&](const Timed& on) { stays.visit(on); });
        });
    std::vector<Finding> found = at_most("altitude_max", rules.limits.ceiling_m, rules.axis_m(), highest);
    for (Finding& finding : at_most("altitude_min_navigation", 0.0, 2.0 * rules.plane_m(), low))
        found.push_back(std::move(finding));
    return found;
}

}  // namespace aerogram::exporter
