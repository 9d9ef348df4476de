#include "planner/motion/act.hpp"

#include <algorithm>
#include <cmath>

#include "geo/contract.hpp"
#include "geo/units.hpp"

namespace aerogram::planner {
namespace {

template <class... Visitors>
struct Overloaded : Visitors... {
    using Visitors::operator()...;
};
template <class... Visitors>
Overloaded(Visitors...) -> Overloaded<Visitors...>;  // clang-tidy 14 does not deduce aggregates

/// Weights of four consecutive rows at share u of their knot interval: position, velocity · h, acceleration · h².
struct Basis {
    std::array<double, 4> position{}, velocity{}, acceleration{};
};

Basis basis(double u) {
    const double v = 1.0 - u;
    Basis b;
    b.position = {v * v * v / 6.0, (3.0 * u * u * u - 6.0 * u * u + 4.0) / 6.0,
                  (3.0 * v * v * v - 6.0 * v * v + 4.0) / 6.0, u * u * u / 6.0};
    b.velocity = {-v * v / 2.0, (3.0 * u * u - 4.0 * u) / 2.0, (4.0 * v - 3.0 * v * v) / 2.0, u * u / 2.0};
    b.acceleration = {v, 3.0 * u - 2.0, 1.0 - 3.0 * u, u};
    return b;
}

struct Place {
    std::size_t interval = 0;
    double share = 0.0;
};

Place place_at(const Act& act, double local_t_s) {
    const std::size_t intervals = interval_count(act.motion);
    const double u = std::clamp(local_t_s / knot_step_s(act), 0.0, static_cast<double>(intervals));
    const std::size_t interval = std::min(static_cast<std::size_t>(u), intervals - 1);
    return {interval, u - static_cast<double>(interval)};
}

Vec3 between(const Vec3& from, const Vec3& to, double s) {
    return (1.0 - s) * from + s * to;  // exact at both ends
}

double weighted(const std::array<double, 4>& w, std::span<const double> rows) {
    return w[0] * rows[0] + w[1] * rows[1] + w[2] * rows[2] + w[3] * rows[3];
}

Vec3 weighted(const std::array<double, 4>& w, const Lattice& lattice, std::size_t row, std::size_t drone) {
    return w[0] * lattice.at(row, drone) + w[1] * lattice.at(row + 1, drone) + w[2] * lattice.at(row + 2, drone) +
           w[3] * lattice.at(row + 3, drone);
}

/// Positions at a knot; exact where the fleet is at rest there.
Points knot_positions(const Motion& motion, std::size_t knot) {
    Points points(drone_count(motion));
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec3 p0 = control_point(motion, knot, i), p1 = control_point(motion, knot + 1, i),
                   p2 = control_point(motion, knot + 2, i);
        points[i] = p0 == p1 && p1 == p2 ? p0 : knot_value(p0, p1, p2);
    }
    return points;
}

}  // namespace

std::size_t drone_count(const Motion& motion) {
    return std::visit(Overloaded{[](const Hold& hold) { return hold.positions_m.size(); },
                                 [](const Straight& straight) { return straight.from_m.size(); },
                                 [](const Lattice& lattice) { return lattice.drones; }},
                      motion);
}

std::size_t interval_count(const Motion& motion) {
    return std::visit(Overloaded{[](const Hold&) { return std::size_t{1}; },
                                 [](const Straight& straight) { return straight.profile.size() - 3; },
                                 [](const Lattice& lattice) { return lattice.rows() - 3; }},
                      motion);
}

double knot_step_s(const Act& act) {
    return seconds_from_ms(act.duration_ms) / static_cast<double>(interval_count(act.motion));
}

Vec3 control_point(const Motion& motion, std::size_t row, std::size_t drone) {
    return std::visit(
        Overloaded{[&](const Hold& hold) { return hold.positions_m[drone]; },
                   [&](const Straight& s) { return between(s.from_m[drone], s.to_m[drone], s.profile[row]); },
                   [&](const Lattice& lattice) { return lattice.at(row, drone); }},
        motion);
}

std::array<Vec3, 4> bezier(const Motion& motion, std::size_t interval, std::size_t drone) {
    const Vec3 p0 = control_point(motion, interval, drone);
    const Vec3 p1 = control_point(motion, interval + 1, drone);
    const Vec3 p2 = control_point(motion, interval + 2, drone);
    const Vec3 p3 = control_point(motion, interval + 3, drone);
    return {knot_value(p0, p1, p2), (2.0 * p1 + p2) / 3.0, (p1 + 2.0 * p2) / 3.0, knot_value(p1, p2, p3)};
}

Kinematics kinematics(const Act& act, DroneId drone, double local_t_s) {
    const Place place = place_at(act, local_t_s);
    const Basis b = basis(place.share);
    const double h = knot_step_s(act);
    return std::visit(Overloaded{[&](const Hold& hold) {
                                     return Kinematics{hold.positions_m[drone.value], Vec3{}, Vec3{}};
                                 },
                                 [&](const Straight& straight) {
                                     const auto rows = std::span(straight.profile).subspan(place.interval, 4);
                                     const Vec3& from = straight.from_m[drone.value];
                                     const Vec3& to = straight.to_m[drone.value];
                                     const Vec3 way = to - from;
                                     return Kinematics{between(from, to, weighted(b.position, rows)),
                                                       way * (weighted(b.velocity, rows) / h),
                                                       way * (weighted(b.acceleration, rows) / (h * h))};
                                 },
                                 [&](const Lattice& lattice) {
                                     return Kinematics{
                                         weighted(b.position, lattice, place.interval, drone.value),
                                         weighted(b.velocity, lattice, place.interval, drone.value) / h,
                                         weighted(b.acceleration, lattice, place.interval, drone.value) / (h * h)};
                                 }},
                      act.motion);
}

void positions(const Act& act, double local_t_s, std::span<Vec3> out) {
    AEROGRAM_REQUIRE(out.size() == drone_count(act.motion), out.size());
    const Place place = place_at(act, local_t_s);
    const Basis b = basis(place.share);
    std::visit(
        Overloaded{[&](const Hold& hold) { std::copy(hold.positions_m.begin(), hold.positions_m.end(), out.begin()); },
                   [&](const Straight& straight) {
                       const double s = weighted(b.position, std::span(straight.profile).subspan(place.interval, 4));
                       for (std::size_t i = 0; i < out.size(); ++i) {
                           out[i] = between(straight.from_m[i], straight.to_m[i], s);
                       }
                   },
                   [&](const Lattice& lattice) {
                       for (std::size_t i = 0; i < out.size(); ++i) {
                           out[i] = weighted(b.position, lattice, place.interval, i);
                       }
                   }},
        act.motion);
}

Points start_positions(const Motion& motion) {
    return knot_positions(motion, 0);
}

Points end_positions(const Motion& motion) {
    return knot_positions(motion, interval_count(motion));
}

Lattice lattice_through(std::span<const Vec3> samples_m, std::size_t drones) {
    AEROGRAM_REQUIRE(drones > 0 && samples_m.size() % drones == 0, drones, samples_m.size());
    const std::size_t rows = samples_m.size() / drones + 2;
    AEROGRAM_REQUIRE(rows >= 9, rows);
    Lattice lattice{drones, Points(rows * drones)};
    const std::span<const Vec3> first = samples_m.first(drones);
    const std::span<const Vec3> last = samples_m.last(drones);
    for (std::size_t i = 0; i < drones; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            lattice.at(k, i) = first[i];
            lattice.at(rows - 1 - k, i) = last[i];
        }
    }
    // Rows 3..K-4 from the values at knots 2..K-5: a tridiagonal system (1, 4, 1) eliminated downwards (Thomas).
    const std::size_t begin = 3, end = rows - 3;
    std::vector<double> upper(rows, 0.0);
    for (std::size_t k = begin; k < end; ++k) {
        const double pivot = 4.0 - (k == begin ? 0.0 : upper[k - 1]);
        upper[k] = 1.0 / pivot;
        for (std::size_t i = 0; i < drones; ++i) {
            Vec3 right = 6.0 * samples_m[(k - 1) * drones + i] - lattice.at(k - 1, i);  // row k-1: known or eliminated
            if (k + 1 == end) right -= lattice.at(end, i);
            lattice.at(k, i) = right / pivot;
        }
    }
    for (std::size_t k = end - 1; k-- > begin;) {
        for (std::size_t i = 0; i < drones; ++i) lattice.at(k, i) -= upper[k] * lattice.at(k + 1, i);
    }
    return lattice;
}

}  // namespace aerogram::planner
