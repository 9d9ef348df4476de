#include <array>

#include "export/verify/rules.hpp"

namespace aerogram::exporter {
namespace {

enum Quantity : std::size_t { horizontal, up, down, acceleration, velocity_jump, position_jump, quantity_count };
using MotionWorst = std::array<Worst, quantity_count>;

double ground_speed(const Vec3& v) {
    return std::hypot(v.x, v.y);
}

/// Raises a largest value, kept as the smallest of its negative. The function must be convex, so that no point of the
/// curve exceeds the largest control point.
template <class Convex>
void maximise(const Timed& on, const Convex& of, Worst& negative) {
    const auto bound = [&of](const Bezier& curve) {
        double largest = -std::numeric_limits<double>::infinity();
        for (const Vec3& p : curve.controls()) largest = std::max(largest, of(p));
        return -largest;
    };
    minimise(
        on, Tolerance{}, [&of](const Vec3& p) { return -of(p); }, bound, negative);
}

void look_at_drone(const RecordedDrone& drone, MotionWorst& worst) {
    Vec3 position = first_position(drone), velocity{0.0, 0.0, 0.0};
    for (const Piece& piece : drone.pieces) {
        const Timed on{curve_of(drone, piece), piece.start_s, piece.start_s + piece.duration_s};
        const Timed speed = rate(on);
        maximise(speed, ground_speed, worst[horizontal]);
        maximise(
            speed, [](const Vec3& v) { return v.z; }, worst[up]);
        maximise(
            speed, [](const Vec3& v) { return -v.z; }, worst[down]);
        maximise(
            rate(speed), [](const Vec3& a) { return glm::length(a); }, worst[acceleration]);
        worst[velocity_jump].meet(-glm::length(speed.curve.front() - velocity), on.begin_s);
        worst[position_jump].meet(-glm::length(on.curve.front() - position), on.begin_s);
        velocity = speed.curve.back();
        position = on.curve.back();
    }
    worst[velocity_jump].meet(-glm::length(velocity), end_s(drone));
}

}  // namespace

std::vector<Finding> motion_findings(const RecordedShow& show, const Rules& rules, const Run& run) {
    std::vector<MotionWorst> each(show.drones.size());
    parallel_for(each.size(), run, "verifying speeds", [&](std::size_t d) { look_at_drone(show.drones[d], each[d]); });
    std::array<FleetWorst, quantity_count> fleet;
    for (std::size_t d = 0; d < each.size(); ++d) {
        for (std::size_t q = 0; q < quantity_count; ++q) {
            if (each[d][q].bound < fleet[q].worst.bound) fleet[q] = {each[d][q], d};
        }
    }
    const Rounding& rounding = rules.rounding;
    std::vector<Finding> found;
    const auto add = [&](std::string rule, double limit, double allowance, Quantity quantity) {
        for (Finding& finding : at_most(std::move(rule), limit, allowance, fleet[quantity]))
            found.push_back(std::move(finding));
    };
    if (rounding.has_speed) {
        add("speed_horizontal", rules.limits.speed_horizontal_mps, rounding.speed_allowance_mps, horizontal);
        add("speed_up", rules.limits.speed_up_mps, rounding.speed_allowance_mps, up);
        add("speed_down", rules.limits.speed_down_mps, rounding.speed_allowance_mps, down);
    }
    if (rounding.has_acceleration) {
        add("acceleration", rules.limits.acceleration_mps2, rounding.acceleration_allowance_mps2, acceleration);
        add("velocity_jump", 0.0, 2.0 * rounding.speed_allowance_mps, velocity_jump);
    }
    add("position_jump", 0.0, 2.0 * rules.space_m(), position_jump);
    return found;
}

}  // namespace aerogram::exporter
