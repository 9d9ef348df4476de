#include "planner/carrier/carrier_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "geo/contract.hpp"
#include "geo/units.hpp"

namespace aerogram::planner {
namespace {

constexpr double kShare = 0.5;        ///< of the limits, for the carrier's turns
constexpr double kSlopeShare = 0.25;  ///< of the limits, for its changes of slope
constexpr double kNoSlope = 1e-9;
constexpr double kRampSlope = 1.5;   ///< the largest slope of u²(3 - 2u), by which curvatures and slopes change
constexpr double kSwing_s = 3.0;     ///< a turn that swings formations round is entered this slowly
constexpr double kSwingShare = 0.5;  ///< and is this much gentler
constexpr double kNoTurn_rad = 1e-9;
constexpr double kTurnsBack_rad = kPi - 1e-3;
constexpr double kPanel_rad = 0.5;  ///< a quadrature panel turns no more than this

/// Gauss-Legendre nodes and weights on [-1, 1], positive half.
constexpr std::array<double, 4> kNodes{0.18343464249564980494, 0.52553240991632898582, 0.79666647741362673959,
                                       0.96028985649753623168};
constexpr std::array<double, 4> kWeights{0.36268378337836198297, 0.31370664587788728734, 0.22238103445337447054,
                                         0.10122853629037625915};

std::string shown(double value) {
    std::ostringstream text;
    text << value;
    return text.str();
}

std::string metres(double value) {
    std::ostringstream text;
    text << std::fixed << std::setprecision(1) << value << " m";
    return text.str();
}

Error refused(const Mission& mission, const std::string& what) {
    return {ErrorCode::infeasible, mission.at(mission.carrier->line, "carrier.waypoints_m: " + what)};
}

std::string between(std::size_t w) {
    return "from waypoint " + std::to_string(w + 1) + " to " + std::to_string(w + 2);
}

/// The largest curvature of a turn, how fast it may rise along the way, and the shortest way of its rise.
struct Bend {
    double curvature = 0.0, rise = 0.0;  ///< 1/m, 1/m²
    double ramp_m = 0.0;
};

Bend bend_of(const Limits& limits, const Carrier& carrier) {
    const double v = carrier.speed_mps;
    Bend bend{kShare * limits.acceleration_mps2 / (v * v), kShare * limits.jerk_mps3 / (v * v * v), 0.0};
    if (limits.plane) bend.curvature = std::min(bend.curvature, kShare * radians(limits.plane->turn_rate_dps) / v);
    if (carrier.turn) {  // who is far from the carrier swings round it
        bend.curvature *= kSwingShare;
        bend.ramp_m = kSwing_s * v;
    }
    return bend;
}

/// Half the way over which a slope changes; the largest bend of u²(3 - 2u) is 6.
double slope_half_m(double change, double v, const Limits& limits) {
    return 0.5 * std::max(kRampSlope * v * v * change / (kSlopeShare * limits.acceleration_mps2),
                          std::sqrt(6.0 * v * v * v * change / (kSlopeShare * limits.jerk_mps3)));
}

}  // namespace

struct CarrierPath::Turn {
    double angle_rad = 0.0;               ///< positive to the left
    double curvature = 0.0;               ///< of its middle
    double ramp_m = 0.0, circle_m = 0.0;  ///< two ramps, the circle between them
    double reach_m = 0.0;                 ///< from where it begins to its waypoint

    static Turn of(double angle_rad, const Bend& bend) {
        Turn turn;
        turn.angle_rad = angle_rad;
        const double angle = std::abs(angle_rad);
        if (angle <= kNoTurn_rad || angle >= kTurnsBack_rad) return turn;
        turn.curvature = std::min(bend.curvature, std::sqrt(angle * bend.rise / kRampSlope));
        turn.ramp_m = kRampSlope * turn.curvature / bend.rise;
        if (turn.ramp_m < bend.ramp_m) {
            turn.ramp_m = bend.ramp_m;
            turn.curvature = std::min(bend.curvature, angle / turn.ramp_m);
        }
        turn.circle_m = std::max(0.0, angle / turn.curvature - turn.ramp_m);
        // Half of it, laid out from the origin: by symmetry its middle is on the line that halves the corner.
        CarrierPath half;
        half.add(turn.ramp_m, 0.0, turn.curvature);
        half.add(0.5 * turn.circle_m, turn.curvature, turn.curvature);
        turn.reach_m = half.end_m_.x + half.end_m_.y * std::tan(0.5 * angle);
        return turn;
    }
    [[nodiscard]] double length_m() const { return 2.0 * ramp_m + circle_m; }
};

double CarrierPath::Piece::heading_at(double s_m) const {
    const double u = s_m / length_m;
    return heading_rad + curvature_begin * s_m +
           (curvature_end - curvature_begin) * length_m * u * u * u * (1.0 - 0.5 * u);
}

Vec2 CarrierPath::Piece::at(double s_m) const {
    const auto towards = [&](double s) { return Vec2{std::cos(heading_at(s)), std::sin(heading_at(s))}; };
    const double panels = std::ceil(std::abs(heading_at(s_m) - heading_rad) / kPanel_rad);
    if (panels <= 0.0) return from_m + s_m * towards(0.0);
    const double half_m = 0.5 * s_m / panels;
    Vec2 way{};
    for (double panel = 0.0; panel < panels; ++panel) {
        const double middle_m = (2.0 * panel + 1.0) * half_m;
        for (std::size_t g = 0; g < kNodes.size(); ++g) {
            way += kWeights[g] * half_m *
                   (towards(middle_m - kNodes[g] * half_m) + towards(middle_m + kNodes[g] * half_m));
        }
    }
    return from_m + way;
}

void CarrierPath::add(double length_m, double curvature_begin, double curvature_end) {
    if (length_m <= 0.0) return;
    const double begin_m = pieces_.empty() ? 0.0 : this->length_m();
    pieces_.push_back({begin_m, length_m, end_m_, heading_rad_, curvature_begin, curvature_end});
    end_m_ = pieces_.back().at(length_m);
    heading_rad_ = pieces_.back().heading_at(length_m);
}

Result<CarrierPath> CarrierPath::through(const Mission& mission) {
    AEROGRAM_REQUIRE(mission.carrier.has_value());
    const Carrier& carrier = *mission.carrier;
    const Points& places = carrier.waypoints_m;
    AEROGRAM_REQUIRE(places.size() >= 2 && carrier.speed_mps > 0.0, places.size(), carrier.speed_mps);
    const Bend bend = bend_of(mission.limits, carrier);
    const auto way = [&](std::size_t w) { return Vec2(places[w + 1]) - Vec2(places[w]); };
    const auto heading = [&](std::size_t w) { return std::atan2(way(w).y, way(w).x); };
    std::vector<Turn> turns(places.size());
    for (std::size_t w = 1; w + 1 < places.size(); ++w) {
        turns[w] = Turn::of(std::remainder(heading(w) - heading(w - 1), 2.0 * kPi), bend);
        if (std::abs(turns[w].angle_rad) < kTurnsBack_rad) continue;
        return refused(mission, "the route turns back on itself at waypoint " + std::to_string(w + 1) +
                                    "; put a waypoint or two beside it");
    }
    CarrierPath path;
    path.end_m_ = Vec2(places.front());
    path.slopes_.push_back({0.0, places.front().z, 0.0});
    for (std::size_t w = 0; w + 1 < places.size(); ++w) {
        const Turn& turn = turns[w + 1];
        const double way_m = glm::length(way(w)), turning_m = turns[w].reach_m + turn.reach_m;
        if (way_m < turning_m) {
            return refused(mission, between(w) + " it is " + metres(way_m) + "; its turns at " +
                                        shown(carrier.speed_mps) + " m/s need " + metres(turning_m));
        }
        path.heading_rad_ = heading(w);
        path.add(way_m - turning_m, 0.0, 0.0);
        const double curvature = std::copysign(turn.curvature, turn.angle_rad);
        const double begin_m = path.pieces_.empty() ? 0.0 : path.length_m();
        path.slopes_.push_back({begin_m + 0.5 * turn.length_m(), places[w + 1].z, 0.0});
        path.add(turn.ramp_m, 0.0, curvature);
        path.add(turn.circle_m, curvature, curvature);
        path.add(turn.ramp_m, curvature, 0.0);
    }
    if (auto done = path.round_slopes(mission); !done) return done.error();
    return path;
}

Status CarrierPath::round_slopes(const Mission& mission) {
    for (std::size_t b = 1; b + 1 < slopes_.size(); ++b) {
        const double change = std::abs(slope_after(b) - slope_after(b - 1));
        if (change > kNoSlope) slopes_[b].half_m = slope_half_m(change, mission.carrier->speed_mps, mission.limits);
    }
    for (std::size_t b = 0; b + 1 < slopes_.size(); ++b) {
        const double way_m = slopes_[b + 1].at_m - slopes_[b].at_m,
                     needed_m = slopes_[b].half_m + slopes_[b + 1].half_m;
        if (way_m >= needed_m) continue;
        return refused(mission, between(b) + " it is " + metres(way_m) + "; its changes of slope at " +
                                    shown(mission.carrier->speed_mps) + " m/s need " + metres(needed_m));
    }
    return Done{};
}

double CarrierPath::length_m() const {
    return pieces_.back().begin_m + pieces_.back().length_m;
}

const CarrierPath::Piece& CarrierPath::piece_at(double s_m) const {
    const auto after = std::upper_bound(pieces_.begin() + 1, pieces_.end(), s_m,
                                        [](double s, const Piece& piece) { return s < piece.begin_m; });
    return *std::prev(after);
}

double CarrierPath::slope_after(std::size_t bend) const {
    const Slope &from = slopes_[bend], &to = slopes_[bend + 1];
    return (to.z_m - from.z_m) / (to.at_m - from.at_m);
}

double CarrierPath::height_at(double s_m) const {
    std::size_t line = 0;
    while (line + 2 < slopes_.size() && slopes_[line + 1].at_m < s_m) ++line;
    const double height = slopes_[line].z_m + slope_after(line) * (s_m - slopes_[line].at_m);
    for (std::size_t b = std::max<std::size_t>(line, 1); b <= line + 1 && b + 1 < slopes_.size(); ++b) {
        const double half = slopes_[b].half_m, off = std::abs(s_m - slopes_[b].at_m);
        if (off >= half) continue;
        // What the smooth change of slope adds to the corner of two lines; it is even about the bend.
        const double u = 0.5 * (1.0 - off / half);
        return height + 2.0 * half * (slope_after(b) - slope_after(b - 1)) * u * u * u * (1.0 - 0.5 * u);
    }
    return height;
}

Vec3 CarrierPath::at(double s_m) const {
    const double s = std::clamp(s_m, 0.0, length_m());
    const Piece& piece = piece_at(s);
    return {piece.at(s - piece.begin_m), height_at(s)};
}

Vec2 CarrierPath::direction(double s_m) const {
    const double s = std::clamp(s_m, 0.0, length_m());
    const Piece& piece = piece_at(s);
    const double heading = piece.heading_at(s - piece.begin_m);
    return {std::cos(heading), std::sin(heading)};
}

double CarrierPath::yaw_rad(double s_m) const {
    const Vec2 d = direction(s_m);
    return std::atan2(-d.x, d.y);
}

}  // namespace aerogram::planner
