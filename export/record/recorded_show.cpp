#include "export/record/recorded_show.hpp"

#include <algorithm>
#include <cmath>

namespace aerogram::exporter {
namespace {

constexpr double kFarthest_m = 1e8;
constexpr double kLargestGap_s = 1e-6;

std::string flaw_of_piece(const RecordedDrone& drone, std::size_t index) {
    const Piece& piece = drone.pieces[index];
    if (piece.degree > kMaxDegree) return "degree " + std::to_string(piece.degree) + " is above 7";
    if (!std::isfinite(piece.start_s) || !(piece.duration_s > 0.0) || !std::isfinite(piece.duration_s)) {
        return "start " + std::to_string(piece.start_s) + " s, duration " + std::to_string(piece.duration_s) +
               " s: must be finite and the duration > 0";
    }
    if (std::size_t{piece.first_control} + piece.degree >= drone.controls_m.size())
        return "its control points are missing";
    for (std::size_t i = 0; i <= piece.degree; ++i) {
        const Vec3& p = drone.controls_m[piece.first_control + i];
        const bool sound = is_finite(p) && std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) <= kFarthest_m;
        if (!sound) return "a control point is not finite or beyond 1e8 m";
    }
    if (index > 0) {
        const Piece& before = drone.pieces[index - 1];
        const double gap = piece.start_s - (before.start_s + before.duration_s);
        if (!(std::abs(gap) <= kLargestGap_s) || !(piece.start_s > before.start_s)) {
            return "starts " + std::to_string(gap) + " s after the piece before ends";
        }
    }
    return {};
}

}  // namespace

Status well_formed(const RecordedShow& show) {
    for (std::size_t d = 0; d < show.drones.size(); ++d) {
        const RecordedDrone& drone = show.drones[d];
        const std::string name = "drone " + std::to_string(d + 1);
        if (show.timed && drone.pieces.empty()) {
            return Error{ErrorCode::invalid_input, name + ": has no trajectory"};
        }
        for (std::size_t k = 0; k < drone.pieces.size(); ++k) {
            const std::string flaw = flaw_of_piece(drone, k);
            if (flaw.empty()) continue;
            std::string message = name + ", piece " + std::to_string(k + 1);
            return Error{ErrorCode::invalid_input, message.append(": ").append(flaw)};
        }
    }
    return Done{};
}

void state_missing_places(RecordedShow& show, std::span<const Vec3> pads_m) {
    if (pads_m.size() != show.drones.size()) return;
    for (std::size_t d = 0; d < pads_m.size(); ++d) {
        RecordedDrone& drone = show.drones[d];
        if (!drone.home_m) drone.home_m = pads_m[d];
        if (!drone.land_m) drone.land_m = pads_m[d];
    }
}

Bezier curve_of(const RecordedDrone& drone, const Piece& piece) {
    Bezier curve;
    curve.degree = piece.degree;
    std::copy_n(drone.controls_m.begin() + piece.first_control, piece.degree + 1, curve.control.begin());
    return curve;
}

std::size_t piece_at(const RecordedDrone& drone, double t_s) {
    AEROGRAM_REQUIRE(!drone.pieces.empty(), drone.name);
    const auto later = std::upper_bound(drone.pieces.begin(), drone.pieces.end(), t_s,
                                        [](double t, const Piece& piece) { return t < piece.start_s; });
    return later == drone.pieces.begin() ? 0 : static_cast<std::size_t>(later - drone.pieces.begin()) - 1;
}

Vec3 position_at(const RecordedDrone& drone, double t_s) {
    const std::size_t k = piece_at(drone, t_s);
    const Piece& piece = drone.pieces[k];
    if (t_s <= piece.start_s) return drone.controls_m[piece.first_control];
    if (t_s >= end_s(drone)) return last_position(drone);
    return value(curve_of(drone, piece), (t_s - piece.start_s) / piece.duration_s);
}

Vec3 velocity_at(const RecordedDrone& drone, double t_s) {
    const std::size_t k = piece_at(drone, t_s);
    const Piece& piece = drone.pieces[k];
    if (t_s < piece.start_s || t_s > end_s(drone)) return {0.0, 0.0, 0.0};
    const double u = (t_s - piece.start_s) / piece.duration_s;
    return value(derivative(curve_of(drone, piece)), u) / piece.duration_s;
}

Vec3 first_position(const RecordedDrone& drone) {
    AEROGRAM_REQUIRE(!drone.pieces.empty(), drone.name);
    return drone.controls_m[drone.pieces.front().first_control];
}

Vec3 last_position(const RecordedDrone& drone) {
    AEROGRAM_REQUIRE(!drone.pieces.empty(), drone.name);
    const Piece& piece = drone.pieces.back();
    return drone.controls_m[std::size_t{piece.first_control} + piece.degree];
}

double end_s(const RecordedDrone& drone) {
    AEROGRAM_REQUIRE(!drone.pieces.empty(), drone.name);
    return drone.pieces.back().start_s + drone.pieces.back().duration_s;
}

}  // namespace aerogram::exporter
