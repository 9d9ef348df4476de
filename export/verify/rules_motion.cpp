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

/// Whether a value, given as its square, is above the largest so far.
bool above(double value2, const Worst& negative) {
    return !(negative.bound <= 0.0) || value2 > negative.bound * negative.bound;
}

/// The largest of a piece's velocity and acceleration control points, which no point of it exceeds.
struct Reach {
    double ground2 = 0.0, up = 0.0, down = 0.0, acceleration2 = 0.0;
    Vec3 first_mps{}, last_mps{};
};

Reach reach_of(std::span<const Vec3> c, double duration_s) {
    Reach reach;
    if (c.size() == 1) return reach;
    const auto degree = static_cast<double>(c.size() - 1);
    const double per_s = degree / duration_s, per_s2 = per_s * (degree - 1.0) / duration_s;
    reach.up = reach.down = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < c.size(); ++i) {
        const Vec3 v = per_s * (c[i + 1] - c[i]);
        reach.ground2 = std::max(reach.ground2, v.x * v.x + v.y * v.y);
        reach.up = std::max(reach.up, v.z);
        reach.down = std::max(reach.down, -v.z);
        if (i == 0) reach.first_mps = v;
        reach.last_mps = v;
    }
    for (std::size_t i = 0; i + 2 < c.size(); ++i) {
        const Vec3 a = per_s2 * (c[i + 2] - 2.0 * c[i + 1] + c[i]);
        reach.acceleration2 = std::max(reach.acceleration2, glm::dot(a, a));
    }
    return reach;
}

/// Halves the curves of a piece that may have a new largest value.
void look_closely(const Timed& on, const Reach& reach, MotionWorst& worst) {
    const Timed speed = rate(on);
    if (above(reach.ground2, worst[horizontal])) maximise(speed, ground_speed, worst[horizontal]);
    maximise(
        speed, [](const Vec3& v) { return v.z; }, worst[up]);
    maximise(
        speed, [](const Vec3& v) { return -v.z; }, worst[down]);
    if (above(reach.acceleration2, worst[acceleration]))
        maximise(
            rate(speed), [](const Vec3& a) { return glm::length(a); }, worst[acceleration]);
}

void jump(const Vec3& by, double t_s, Worst& negative) {
    if (above(glm::dot(by, by), negative)) negative.meet(-glm::length(by), t_s);
}

/// @param rests  the drone must be at rest at the show's ends.
void look_at_drone(const RecordedDrone& drone, bool rests, MotionWorst& worst) {
    Vec3 position = first_position(drone), velocity{0.0, 0.0, 0.0};
    if (!rests) velocity = velocity_at(drone, drone.pieces.front().start_s);
    for (const Piece& piece : drone.pieces) {
        const std::span<const Vec3> controls = controls_of(drone, piece);
        const Reach reach = reach_of(controls, piece.duration_s);
        if (above(reach.ground2, worst[horizontal]) || above(reach.acceleration2, worst[acceleration]) ||
            -reach.up < worst[up].bound || -reach.down < worst[down].bound)
            look_closely(timed(drone, piece), reach, worst);
        jump(reach.first_mps - velocity, piece.start_s, worst[velocity_jump]);
        jump(controls.front() - position, piece.start_s, worst[position_jump]);
        velocity = reach.last_mps;
        position = controls.back();
    }
    if (rests) jump(velocity, end_s(drone), worst[velocity_jump]);
}

}  // namespace

std::vector<Finding> motion_findings(const RecordedShow& show, const Rules& rules, const Run& run) {
    struct Part {
        MotionWorst worst;
        std::array<std::size_t, quantity_count> drone{};
    };
    std::vector<Part> each((show.drones.size() + kDronesAPart - 1) / kDronesAPart);
    parallel_for(each.size(), run, "verifying speeds", [&](std::size_t p) {
        Part& part = each[p];
        for (std::size_t d = p * kDronesAPart; d < std::min(show.drones.size(), (p + 1) * kDronesAPart); ++d) {
            const MotionWorst before = part.worst;
            look_at_drone(show.drones[d], !rules.limits.plane, part.worst);
            for (std::size_t q = 0; q < quantity_count; ++q)
                if (part.worst[q].attained < before[q].attained) part.drone[q] = d;
        }
    });
    std::array<FleetWorst, quantity_count> fleet;
    for (const Part& part : each) {
        for (std::size_t q = 0; q < quantity_count; ++q) {
            if (part.worst[q].bound < fleet[q].worst.bound) fleet[q] = {part.worst[q], part.drone[q]};
        }
    }
    const Rounding& rounding = rules.rounding;
    std::vector<Finding> found;
    const auto add = [&](std::string rule, double limit, double allowance, Quantity quantity) {
        for (Finding& finding : at_most(std::move(rule), limit, allowance, fleet[quantity]))
            found.push_back(std::move(finding));
    };
    if (rounding.has_speed && !rules.limits.plane) {
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
