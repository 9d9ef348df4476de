#include "export/verify/rules_plane.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

enum Quantity : std::size_t { slowest, fastest, climb, sink, turn, quantity_count };
using PlaneWorst = std::array<Worst, quantity_count>;

constexpr Tolerance kTurnTolerance{1e-6, 1e-6};  ///< rad/s
constexpr int kTurnHalvings = 40;

/// No velocity of the hull is shorter along its mean direction.
double least_length(const Bezier& velocity, bool level) {
    const auto seen = [&](const Vec3& v) { return level ? Vec3{v.x, v.y, 0.0} : v; };
    Vec3 mean{};
    for (const Vec3& v : velocity.controls()) mean += seen(v);
    const double length = glm::length(mean);
    if (length <= 0.0) return 0.0;
    double least = std::numeric_limits<double>::infinity();
    for (const Vec3& v : velocity.controls()) least = std::min(least, glm::dot(seen(v), mean) / length);
    return std::max(0.0, least);
}

double largest(const Bezier& velocity, double (*of)(const Vec3&)) {
    double most = -std::numeric_limits<double>::infinity();
    for (const Vec3& v : velocity.controls()) most = std::max(most, of(v));
    return most;
}

double airspeed(const Vec3& v) {
    return glm::length(v);
}
double upwards(const Vec3& v) {
    return v.z;
}
double downwards(const Vec3& v) {
    return -v.z;
}

double across(const Vec3& v, const Vec3& a) {
    return v.x * a.y - v.y * a.x;
}

double turn_rate(const Vec3& v, const Vec3& a) {
    const double squared = v.x * v.x + v.y * v.y;
    return squared > 0.0 ? std::abs(across(v, a)) / squared : std::numeric_limits<double>::infinity();
}

double choose(std::size_t n, std::size_t k) {
    double count = 1.0;
    for (std::size_t i = 1; i <= k; ++i) count = count * static_cast<double>(n - k + i) / static_cast<double>(i);
    return count;
}

/// What the turn rate is nowhere above: the Bernstein coefficients of v × a over the least |v|².
double turn_rate_bound(const Bezier& v, const Bezier& a) {
    const std::size_t degree = v.degree + a.degree;
    double most = 0.0;
    for (std::size_t k = 0; k <= degree; ++k) {
        double coefficient = 0.0;
        for (std::size_t i = k > a.degree ? k - a.degree : 0; i <= std::min(k, v.degree); ++i) {
            coefficient += choose(v.degree, i) * choose(a.degree, k - i) * across(v.control[i], a.control[k - i]);
        }
        most = std::max(most, std::abs(coefficient) / choose(degree, k));
    }
    const double least = least_length(v, true);
    return least > 0.0 ? most / (least * least) : std::numeric_limits<double>::infinity();
}

/// Lowers `worst` to the smallest negative turn rate on a stretch, halving it until that is sure.
void search_turn(const Timed& velocity, int halvings, Worst& worst) {
    const Timed change = rate(velocity);
    const double bound = -turn_rate_bound(velocity.curve, change.curve);
    if (bound >= worst.bound) return;
    worst.attain(-turn_rate(velocity.curve.front(), change.curve.front()), velocity.begin_s);
    worst.attain(-turn_rate(velocity.curve.back(), change.curve.back()), velocity.end_s);
    if (halvings == 0 || bound >= worst.attained - kTurnTolerance.fine || !std::isfinite(worst.attained)) {
        worst.bound = std::min(worst.bound, bound);
        return;
    }
    const auto [left, right] = split(velocity.curve, 0.5);
    const double middle_s = 0.5 * (velocity.begin_s + velocity.end_s);
    search_turn({left, velocity.begin_s, middle_s}, halvings - 1, worst);
    search_turn({right, middle_s, velocity.end_s}, halvings - 1, worst);
}

/// The pieces of a drone whose middles lie within a stretch of the show.
PlaneWorst look_at_drone(const RecordedDrone& drone, double begin_s, double end_s, bool turns) {
    PlaneWorst worst;
    const auto maximise = [](const Timed& on, double (*of)(const Vec3&), Worst& negative) {
        minimise(
            on, Tolerance{}, [of](const Vec3& v) { return -of(v); },
            [of](const Bezier& curve) { return -largest(curve, of); }, negative);
    };
    for (const Piece& piece : drone.pieces) {
        const Timed on{curve_of(drone, piece), piece.start_s, piece.start_s + piece.duration_s};
        const double middle_s = 0.5 * (on.begin_s + on.end_s);
        if (middle_s < begin_s || middle_s > end_s) continue;
        const Timed velocity = rate(on);
        minimise(
            velocity, Tolerance{}, airspeed, [](const Bezier& curve) { return least_length(curve, false); },
            worst[slowest]);
        maximise(velocity, airspeed, worst[fastest]);
        maximise(velocity, upwards, worst[climb]);
        maximise(velocity, downwards, worst[sink]);
        if (turns) search_turn(velocity, kTurnHalvings, worst[turn]);
    }
    return worst;
}

std::array<FleetWorst, quantity_count> look_at_fleet(const RecordedShow& show, double begin_s, double end_s,
                                                     const Run& run) {
    std::vector<PlaneWorst> each(show.drones.size());
    parallel_for(each.size(), run, "verifying planes", [&](std::size_t d) {
        each[d] = look_at_drone(show.drones[d], begin_s, end_s, show.rounding.has_acceleration);
    });
    std::array<FleetWorst, quantity_count> fleet;
    for (std::size_t d = 0; d < each.size(); ++d) {
        for (std::size_t q = 0; q < quantity_count; ++q) {
            if (each[d][q].bound < fleet[q].worst.bound) fleet[q] = {each[d][q], d};
        }
    }
    return fleet;
}

FleetWorst in_degrees(FleetWorst found) {
    found.worst.bound = degrees(found.worst.bound);
    found.worst.attained = degrees(found.worst.attained);
    return found;
}

/// By how much a chord may be slower than the flight between its ends: a² dt² / (24 v).
double chord_allowance_mps(const RecordedShow& show, const Limits& limits) {
    if (show.rounding.has_acceleration) return 0.0;
    double longest_s = 0.0;
    for (const RecordedDrone& drone : show.drones)
        for (const Piece& piece : drone.pieces) longest_s = std::max(longest_s, piece.duration_s);
    const double change_mps = limits.acceleration_mps2 * longest_s;
    return change_mps * change_mps / (24.0 * limits.plane->airspeed_min_mps);
}

/// What a speed allowance and an acceleration allowance may add to a turn rate, degrees a second.
double turn_allowance_dps(const Rounding& rounding, const PlaneLimits& limits) {
    const double level_mps = std::sqrt(std::max(1.0, limits.airspeed_min_mps * limits.airspeed_min_mps -
                                                         std::pow(std::max(limits.climb_mps, limits.sink_mps), 2.0)));
    return degrees(rounding.acceleration_allowance_mps2 / level_mps) +
           2.0 * limits.turn_rate_dps * rounding.speed_allowance_mps / level_mps + 1e-4;
}

}  // namespace

std::vector<Finding> plane_findings(const RecordedShow& show, const Rules& rules, const Run& run) {
    if (!rules.limits.plane || !rules.rounding.has_speed) return {};
    const PlaneLimits& limits = *rules.limits.plane;
    constexpr double kAlways_s = std::numeric_limits<double>::infinity();
    const auto fleet = look_at_fleet(show, -kAlways_s, kAlways_s, run);
    const double speed = rules.rounding.speed_allowance_mps;
    std::vector<Finding> found = at_least("airspeed_min", limits.airspeed_min_mps,
                                          speed + chord_allowance_mps(show, rules.limits), fleet[slowest]);
    const auto add = [&](std::vector<Finding> more) {
        for (Finding& finding : more) found.push_back(std::move(finding));
    };
    add(at_most("airspeed_max", limits.airspeed_max_mps, speed, fleet[fastest]));
    add(at_most("climb", limits.climb_mps, speed, fleet[climb]));
    add(at_most("sink", limits.sink_mps, speed, fleet[sink]));
    if (!rules.rounding.has_acceleration) return found;
    add(at_most("turn_rate_dps", limits.turn_rate_dps, turn_allowance_dps(rules.rounding, limits),
                in_degrees(fleet[turn])));
    return found;
}

std::vector<BrokenClaim> broken_plane_claims(const RecordedShow& show, const Rules& rules, const Claims& claims,
                                             const Run& run) {
    if (!claims.plane || !rules.limits.plane) return {};
    const auto fleet = look_at_fleet(show, claims.begin_s, claims.end_s, run);
    std::vector<BrokenClaim> broken;
    const auto compare = [&](const char* what, double claimed, const FleetWorst& found, double sign, double allowed) {
        const double attained = sign * found.worst.attained;
        if (!found.worst.seen() || sign * (attained - claimed) >= -allowed) return;
        broken.push_back({what, claimed, attained, found.drone, found.worst.time_s});
    };
    const double speed = rules.rounding.speed_allowance_mps + kNumeric;
    compare("min_airspeed_mps", claims.plane->airspeed_min_mps, fleet[slowest], 1.0, speed);
    compare("max_airspeed_mps", claims.plane->airspeed_max_mps, fleet[fastest], -1.0, speed);
    compare("max_turn_rate_dps", claims.plane->turn_rate_dps, in_degrees(fleet[turn]), -1.0,
            turn_allowance_dps(rules.rounding, *rules.limits.plane));
    return broken;
}

}  // namespace aerogram::exporter
