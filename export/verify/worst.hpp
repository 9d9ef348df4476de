#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "export/record/recorded_show.hpp"
#include "geo/run.hpp"

namespace aerogram::exporter {

/// The smallest value of something along curves. bound <= truth <= attained once anything was seen.
struct Worst {
    double bound = std::numeric_limits<double>::infinity();
    double attained = std::numeric_limits<double>::infinity();
    double time_s = 0.0;

    [[nodiscard]] bool seen() const { return attained < std::numeric_limits<double>::infinity(); }
    void attain(double value, double t_s) {
        if (value < attained) {
            attained = value;
            time_s = t_s;
        }
    }
    /// A value known exactly.
    void meet(double value, double t_s) {
        attain(value, t_s);
        bound = std::min(bound, value);
    }
};

/// A curve on its own stretch of show time.
struct Timed {
    Bezier curve;
    double begin_s = 0.0, end_s = 0.0;
};

/// The curve's derivative with respect to time.
inline Timed rate(const Timed& on) {
    Timed rate{derivative(on.curve), on.begin_s, on.end_s};
    for (std::size_t i = 0; i <= rate.curve.degree; ++i) rate.curve.control[i] /= on.end_s - on.begin_s;
    return rate;
}

/// How exactly a minimum is wanted: bound >= attained - above while values are positive, and of values below zero,
/// which break a rule anyway, to 1 % more.
struct Tolerance {
    double fine = 1e-6;
    double coarse = 1e-6;
    [[nodiscard]] double at(double attained) const {
        return attained > 0.0 ? fine : coarse - 0.01 * attained * (coarse > fine);
    }
};

/// Lowers `worst` to the smallest `of(point)` along the curve by halving it until `bound_of(curve)`, a number the
/// values are nowhere below, is conclusive.
template <class Of, class BoundOf>
void minimise(const Timed& on, const Tolerance& tolerance, const Of& of, const BoundOf& bound_of, Worst& worst,
              int halvings = 40) {
    const double bound = bound_of(on.curve);
    if (bound >= worst.bound) return;
    const auto conclusive = [&] { return bound >= worst.attained - tolerance.at(worst.attained); };
    if (!conclusive()) {
        const double middle_s = 0.5 * (on.begin_s + on.end_s);
        worst.attain(of(on.curve.front()), on.begin_s);
        worst.attain(of(value(on.curve, 0.5)), middle_s);
        worst.attain(of(on.curve.back()), on.end_s);
        if (!conclusive() && halvings > 0) {
            const auto [left, right] = split(on.curve, 0.5);
            minimise(Timed{left, on.begin_s, middle_s}, tolerance, of, bound_of, worst, halvings - 1);
            minimise(Timed{right, middle_s, on.end_s}, tolerance, of, bound_of, worst, halvings - 1);
            return;
        }
    }
    worst.bound = std::min(worst.bound, bound);
}

/// The worst of a fleet, and whose it is.
struct FleetWorst {
    Worst worst;
    std::size_t drone = 0;  ///< 0-based
};

inline constexpr std::size_t kDronesAPart = 128;

/// `per_drone(drone, worst)` for each drone, with the worst of those before it in the same part of the fleet, so that
/// what cannot be worse is passed over; the least bound, of the first part that has it, whatever the threads.
inline FleetWorst worst_of_fleet(const std::vector<RecordedDrone>& drones, const Run& run, std::string_view stage,
                                 const std::function<void(const RecordedDrone&, Worst&)>& per_drone) {
    std::vector<FleetWorst> each((drones.size() + kDronesAPart - 1) / kDronesAPart);
    parallel_for(each.size(), run, stage, [&](std::size_t part) {
        Worst& worst = each[part].worst;
        for (std::size_t d = part * kDronesAPart; d < std::min(drones.size(), (part + 1) * kDronesAPart); ++d) {
            const double before = worst.attained;
            per_drone(drones[d], worst);
            if (worst.attained < before) each[part].drone = d;
        }
    });
    FleetWorst fleet;
    for (const FleetWorst& part : each) {
        if (part.worst.bound < fleet.worst.bound) fleet = part;
    }
    return fleet;
}

/// A piece's control points where they are.
[[nodiscard]] inline std::span<const Vec3> controls_of(const RecordedDrone& drone, const Piece& piece) {
    return {&drone.controls_m[piece.first_control], std::size_t{piece.degree} + 1};
}
/// A piece with its time.
[[nodiscard]] inline Timed timed(const RecordedDrone& drone, const Piece& piece) {
    return {curve_of(drone, piece), piece.start_s, piece.start_s + piece.duration_s};
}

}  // namespace aerogram::exporter
