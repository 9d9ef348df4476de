#include "export/outgoing/flight.hpp"

#include <algorithm>

namespace aerogram::exporter {
namespace {

Bezier curve_of(const Flight& flight, const Piece& piece) {
    Bezier curve;
    curve.degree = piece.degree;
    for (std::size_t c = 0; c <= curve.degree; ++c) curve.control[c] = flight.controls_m[piece.first_control + c];
    return curve;
}

double end_s(const Piece& piece) {
    return piece.start_s + piece.duration_s;
}

Vec3 point_of(const Flight& flight, const Piece& piece, double u) {
    const Vec3* c = &flight.controls_m[piece.first_control];
    const double v = 1.0 - u;
    if (piece.degree == 0) return c[0];
    if (piece.degree == 1) return v * c[0] + u * c[1];
    if (piece.degree == 3) return (v * v * v) * c[0] + (3.0 * u * v) * (v * c[1] + u * c[2]) + (u * u * u) * c[3];
    return value(curve_of(flight, piece), u);
}

}  // namespace

const Piece& FlightCursor::go_to(double t_s) {
    const std::vector<Piece>& pieces = flight_.pieces;
    if (t_s < pieces[piece_].start_s) piece_ = 0;
    while (piece_ + 1 < pieces.size() && t_s >= pieces[piece_ + 1].start_s) ++piece_;
    return pieces[piece_];
}

Vec3 FlightCursor::position_at(double t_s) {
    const Piece& piece = go_to(t_s);
    return point_of(flight_, piece, std::clamp((t_s - piece.start_s) / piece.duration_s, 0.0, 1.0));
}

FlightState FlightCursor::state_at(double t_s) {
    const Piece& piece = go_to(t_s);
    const double u = std::clamp((t_s - piece.start_s) / piece.duration_s, 0.0, 1.0);
    FlightState state{point_of(flight_, piece, u), {}, {}};
    if (t_s < flight_.pieces.front().start_s || t_s > end_s(flight_.pieces.back())) return state;
    const Bezier first = derivative(curve_of(flight_, piece)), second = derivative(first);
    state.velocity_mps = value(first, u) / piece.duration_s;
    state.acceleration_mps2 = value(second, u) / (piece.duration_s * piece.duration_s);
    return state;
}

double largest_acceleration_mps2(const Flight& flight) {
    double largest = 0.0;
    for (const Piece& piece : flight.pieces) {
        const Bezier second = derivative(derivative(curve_of(flight, piece)));
        for (const Vec3& a : second.controls())
            largest = std::max(largest, glm::length(a) / (piece.duration_s * piece.duration_s));
    }
    return largest;
}

}  // namespace aerogram::exporter
