#include "export/verify/altitude.hpp"
#include "export/verify/rules.hpp"

namespace aerogram::exporter {
namespace {

constexpr double kShortest_s = 1e-5;     ///< a crossing of an altitude is found this exactly
constexpr double kBelowGround_m = 0.05;  ///< what standing, taking off and landing may be below the ground

/// From where the lowest altitude counts: home, or a landing place that is stated and lower.
Vec3 lowest_ground(const RecordedDrone& drone, const std::optional<geo::ShowFrame>& frame) {
    const Vec3 home = home_of(drone);
    return drone.land_m && Altitude(frame, home).of(*drone.land_m) < 0.0 ? *drone.land_m : home;
}

/// Follows one drone and measures how far it gets, horizontally, from where each stay below a threshold began.
class LowStays {
  public:
    LowStays(const Altitude& altitude, double threshold_m, Worst& negative)
        : altitude_(altitude), threshold_m_(threshold_m), negative_(negative) {}

    void follow(const RecordedDrone& drone) {
        for (const Piece& piece : drone.pieces) {
            if (altitude_.rough(controls_of(drone, piece)).low >= threshold_m_) {
                anchor_.reset();
            } else {
                visit(timed(drone, piece));
            }
        }
    }

  private:
    void visit(const Timed& on) {
        AltitudeRange range = altitude_.rough(on.curve.controls());
        if (range.low < threshold_m_ && range.high >= threshold_m_) range = altitude_.range(on.curve);
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
                const double rough = -altitude.rough(curve.controls()).high;
                return rough >= worst.bound ? rough : -altitude.range(curve).high;
            };
            for (const Piece& piece : drone.pieces) {
                if (-altitude.rough(controls_of(drone, piece)).high < worst.bound)
                    minimise(timed(drone, piece), Tolerance{}, of, bound, worst);
            }
        });
    const FleetWorst lowest =
        worst_of_fleet(show.drones, run, "verifying lowest altitudes", [&](const RecordedDrone& drone, Worst& worst) {
            const Altitude altitude(rules.frame, lowest_ground(drone, rules.frame));
            const auto of = [&](const Vec3& p) { return altitude.of(p); };
            const auto bound = [&](const Bezier& curve) {
                const double rough = altitude.rough(curve.controls()).low;
                return rough >= worst.bound ? rough : altitude.range(curve).low;
            };
            for (const Piece& piece : drone.pieces) {
                if (altitude.rough(controls_of(drone, piece)).low < worst.bound)
                    minimise(timed(drone, piece), Tolerance{}, of, bound, worst);
            }
        });
    const double threshold_m = rules.limits.min_navigation_altitude_m - rules.axis_m() - kAltitude_m - kNumeric;
    const FleetWorst low =
        worst_of_fleet(show.drones, run, "verifying low flight", [&](const RecordedDrone& drone, Worst& worst) {
            const Altitude altitude(rules.frame, home_of(drone));
            LowStays(altitude, threshold_m, worst).follow(drone);
        });
    std::vector<Finding> found = at_most("altitude_max", rules.limits.ceiling_m, rules.axis_m() + kAltitude_m, highest);
    for (Finding& finding : at_least("altitude_min", 0.0, kBelowGround_m + rules.axis_m(), lowest))
        found.push_back(std::move(finding));
    for (Finding& finding : at_most("altitude_min_navigation", 0.0, 2.0 * rules.plane_m(), low))
        found.push_back(std::move(finding));
    return found;
}

}  // namespace aerogram::exporter
