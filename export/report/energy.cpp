#include <algorithm>
#include <array>
#include <cmath>

#include "export/report/survey.hpp"

namespace aerogram::exporter {
namespace {

constexpr double kGravity_mps2 = 9.80665;
/// Induced velocity of a hovering rotor: sqrt(T / (2 rho A)), 4 to 6 m/s for show copters of 0.5 to 1.5 kg.
constexpr double kInduced_mps = 5.0;

/// Power over that of hovering: momentum theory, thrust^1.5, and the climb's own in the same theory.
double power(const Vec3& velocity, const Vec3& acceleration) {
    const Vec3 thrust = acceleration + Vec3{0.0, 0.0, kGravity_mps2};
    const double loaded = glm::length(thrust) / kGravity_mps2;
    const double climb = std::max(0.0, velocity.z) / (2.0 * kInduced_mps);
    return loaded * std::sqrt(loaded) * (climb + std::sqrt(climb * climb + 1.0));
}

/// The mean power of a piece between two of its parameters, by Gauss's rule with three points.
double mean_power(const Bezier& rate, const Bezier& change, double from, double to) {
    constexpr double kFar = 0.7745966692414834;
    constexpr std::array<std::array<double, 2>, 3> kPoints{
        {{-kFar, 5.0 / 18.0}, {0.0, 8.0 / 18.0}, {kFar, 5.0 / 18.0}}};
    double mean = 0.0;
    for (const auto& [at, weight] : kPoints) {
        const double u = 0.5 * (from + to) + 0.5 * (to - from) * at;
        mean += weight * power(value(rate, u), value(change, u));
    }
    return mean;
}

double seconds_on_pad(const std::vector<Stay>& stays, double begin_s, double end_s) {
    double on_pad_s = 0.0;
    for (const Stay& stay : stays) {
        if (stay.stance == Stance::on_pad)
            on_pad_s += std::max(0.0, std::min(stay.end_s, end_s) - std::max(stay.begin_s, begin_s));
    }
    return on_pad_s;
}

}  // namespace

double hover_seconds(const RecordedDrone& drone, const std::vector<Stay>& stays, bool plane) {
    double all_s = 0.0;
    for (const Piece& piece : drone.pieces) {
        const double in_air_s =
            piece.duration_s - seconds_on_pad(stays, piece.start_s, piece.start_s + piece.duration_s);
        if (!(in_air_s > 0.0)) continue;
        if (piece.degree == 0 || plane) {
            all_s += in_air_s;
            continue;
        }
        Bezier rate = derivative(curve_of(drone, piece)), change = derivative(rate);
        for (Vec3& v : rate.control) v /= piece.duration_s;
        for (Vec3& a : change.control) a /= piece.duration_s * piece.duration_s;
        const double parts = std::clamp(std::ceil(piece.duration_s), 1.0, 64.0);
        double mean = 0.0;
        for (double p = 0.0; p < parts; p += 1.0) mean += mean_power(rate, change, p / parts, (p + 1.0) / parts);
        all_s += in_air_s * mean / parts;
    }
    return all_s;
}

std::string energy_model(bool plane) {
    if (plane) return "a share of the endurance for every second in the air";
    return "power over hovering = (|a + g| / g)^1.5 (c + sqrt(c^2 + 1)), c = climb speed / 10 m/s, descending as "
           "hovering; standing costs nothing; the endurance is hovering time; wind and drag are not in it";
}

}  // namespace aerogram::exporter
