#include "export/vehicle/septic_fit.hpp"

#include <algorithm>
#include <cmath>

#include "export/outgoing/curve_fit.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

constexpr std::size_t kDegree = kSepticTerms - 1;
constexpr std::size_t kSamples = 24;
constexpr double kLongestPiece_s = 30.0;  ///< of one that moves: longer ones would lose digits of floats
constexpr double kShortestPiece_s = 0.05;
constexpr double kSameTime_s = 1e-4;  ///< durations are floats: ends are met to this
constexpr double kShortestStand_s = 0.25;
constexpr double kAims_m[] = {0.004, 1.0};
constexpr double kStep_s = 0.02;  ///< ends of pieces are sought to this

/// Between two of these is one stand, or one motion to be cut further.
struct Span {
    double from_s = 0.0, to_s = 0.0;
    bool stands = false;
};

double end_of(const Flight& flight) {
    return flight.pieces.back().start_s + flight.pieces.back().duration_s;
}

Bezier curve_in(const Flight& flight, const Piece& piece) {
    Bezier curve;
    curve.degree = piece.degree;
    for (std::size_t c = 0; c <= curve.degree; ++c) curve.control[c] = flight.controls_m[piece.first_control + c];
    return curve;
}

bool stands(const Flight& flight, const Piece& piece) {
    for (std::size_t c = 1; c <= piece.degree; ++c)
        if (flight.controls_m[piece.first_control + c] != flight.controls_m[piece.first_control]) return false;
    return true;
}

std::vector<Span> spans_of(const Flight& flight, const std::vector<YawKey>& yaw) {
    std::vector<Span> whole;
    for (const Piece& piece : flight.pieces) {
        const Span span{piece.start_s, piece.start_s + piece.duration_s, stands(flight, piece)};
        if (!whole.empty() && whole.back().stands == span.stands) {
            whole.back().to_s = span.to_s;
        } else {
            whole.push_back(span);
        }
    }
    std::vector<Span> spans;
    for (Span span : whole) {
        if (span.stands && span.to_s - span.from_s < kShortestStand_s) span.stands = false;
        const bool goes_on = !spans.empty() && !spans.back().stands && !span.stands;
        if (goes_on) {
            spans.back().to_s = span.to_s;
        } else {
            spans.push_back(span);
        }
    }
    for (const YawKey& key : yaw) {
        const double at_s = seconds_from_ms(key.time_ms);
        const auto cut = std::ranges::find_if(spans, [&](const Span& s) {
            return s.from_s + kShortestPiece_s < at_s && at_s < s.to_s - kShortestPiece_s;
        });
        if (cut == spans.end()) continue;
        const Span later{at_s, cut->to_s, cut->stands};
        cut->to_s = at_s;
        spans.insert(cut + 1, later);
    }
    return spans;
}

class Fitter {
  public:
    Fitter(const Flight& flight, const std::vector<YawKey>& yaw, const FitError& bound, double acceleration_mps2)
        : flight_(flight), yaw_(yaw), cursor_(flight), bound_(bound), allowed_mps2_(acceleration_mps2) {}

    SepticFit fit(const std::vector<Span>& spans) {
        result_ = {};
        at_s_ = 0.0;
        for (const Span& span : spans) {
            if (span.stands) {
                keep(stand(span.to_s), {});
                continue;
            }
            while (span.to_s - at_s_ > kSameTime_s) keep_longest(span.to_s);
        }
        return std::move(result_);
    }

  private:
    struct Tried {
        SepticPiece piece;
        FitError error;
    };

    void keep(const SepticPiece& piece, const FitError& error) {
        result_.pieces.push_back(piece);
        result_.error.position_m = std::max(result_.error.position_m, error.position_m);
        result_.error.speed_mps = std::max(result_.error.speed_mps, error.speed_mps);
        result_.error.acceleration_mps2 = std::max(result_.error.acceleration_mps2, error.acceleration_mps2);
        at_s_ += static_cast<double>(piece.duration_s);
    }

    SepticPiece stand(double to_s) {
        SepticPiece piece;
        piece.duration_s = static_cast<float>(to_s - at_s_);
        Bezier curve;
        curve.degree = kDegree;
        curve.control.fill(cursor_.position_at(0.5 * (at_s_ + to_s)));
        set_powers(piece, curve);
        set_yaw(piece);
        return piece;
    }

    /// The longest piece from here that is within the bound; at least kShortestPiece_s whatever it misses by. First the
    /// whole, then by halves: nearly monotonic is enough, each piece is measured.
    void keep_longest(double span_end_s) {
        const double longest_s = std::min(span_end_s - at_s_, kLongestPiece_s);
        if (Tried whole = tried(longest_s); whole.error.within(bound_)) return keep(whole.piece, whole.error);
        double good_s = 0.0, bad_s = longest_s;
        Tried best;
        while (bad_s - good_s > kStep_s) {
            const double middle_s = 0.5 * (good_s + bad_s);
            if (middle_s < kShortestPiece_s) break;
            Tried next = tried(middle_s);
            if (next.error.within(bound_)) {
                good_s = middle_s;
                best = next;
            } else {
                bad_s = middle_s;
            }
        }
        const double rest_s = span_end_s - at_s_ - good_s;
        if (rest_s < kShortestPiece_s && good_s > 2.0 * kShortestPiece_s) {  // too little for a piece of its own
            good_s -= kShortestPiece_s;
            best = tried(good_s);
        }
        if (good_s == 0.0) best = tried(std::min(longest_s, kShortestPiece_s));
        keep(best.piece, best.error);
    }

    Tried tried(double duration_s) {
        Tried result;
        result.piece.duration_s = static_cast<float>(duration_s);
        Bezier curve = ends(static_cast<double>(result.piece.duration_s));
        const double missed_m = fill_middle(curve, static_cast<double>(result.piece.duration_s));
        if (missed_m > bound_.position_m) {  // no need to measure soundly
            result.error.position_m = missed_m;
            if (duration_s > kShortestPiece_s) return result;
        }
        set_powers(result.piece, curve);
        set_yaw(result.piece);
        result.error = measured(result.piece);
        return result;
    }

    /// The outer six controls: place, velocity, acceleration at both ends.
    Bezier ends(double t) {
        const FlightState a = cursor_.state_at(at_s_), b = cursor_.state_at(std::min(at_s_ + t, end_of(flight_)));
        Bezier curve;
        curve.degree = kDegree;
        auto& c = curve.control;
        c[0] = a.position_m;
        c[1] = c[0] + t / 7.0 * a.velocity_mps;
        c[2] = 2.0 * c[1] - c[0] + t * t / 42.0 * a.acceleration_mps2;
        c[7] = b.position_m;
        c[6] = c[7] - t / 7.0 * b.velocity_mps;
        c[5] = 2.0 * c[6] - c[7] + t * t / 42.0 * b.acceleration_mps2;
        return curve;
    }

    /// The two inner controls by least squares. @returns the most that a sample misses by.
    double fill_middle(Bezier& curve, double t) {
        std::array<Vec3, kSamples> left{};  // what the inner two have to bring
        std::array<double, kSamples> w3{}, w4{};
        double a33 = 0.0, a34 = 0.0, a44 = 0.0;
        Vec3 r3{}, r4{};
        curve.control[3] = curve.control[4] = Vec3{};
        for (std::size_t k = 0; k < kSamples; ++k) {
            const double u = (static_cast<double>(k) + 0.5) / kSamples, v = 1.0 - u;
            w3[k] = 35.0 * u * u * u * v * v * v * v;
            w4[k] = 35.0 * u * u * u * u * v * v * v;
            left[k] = cursor_.position_at(at_s_ + u * t) - value(curve, u);
            a33 += w3[k] * w3[k], a34 += w3[k] * w4[k], a44 += w4[k] * w4[k];
            r3 += w3[k] * left[k], r4 += w4[k] * left[k];
        }
        const double det = a33 * a44 - a34 * a34;
        curve.control[3] = (a44 * r3 - a34 * r4) * (1.0 / det);
        curve.control[4] = (a33 * r4 - a34 * r3) * (1.0 / det);
        double missed_m = 0.0;
        for (std::size_t k = 0; k < kSamples; ++k)
            missed_m = std::max(missed_m, glm::length(left[k] - w3[k] * curve.control[3] - w4[k] * curve.control[4]));
        return missed_m;
    }

    /// Control polygons of the difference on every stretch where the flight is one polynomial.
    FitError measured(const SepticPiece& piece) {
        const Bezier fit = curve_of(piece);
        const double length_s = static_cast<double>(piece.duration_s), last_s = at_s_ + length_s;
        FitError error;
        double peak_mps2 = 0.0;
        auto p = std::ranges::upper_bound(flight_.pieces, at_s_, {}, &Piece::start_s);
        if (p != flight_.pieces.begin()) --p;
        for (double from_s = at_s_; from_s < last_s && p != flight_.pieces.end(); ++p) {
            const bool final = p + 1 == flight_.pieces.end();
            const double to_s = final ? last_s : std::min(last_s, p->start_s + p->duration_s);
            if (to_s - from_s < 1e-9) continue;
            const Bezier exact =
                elevated(restricted(curve_in(flight_, *p), std::max(0.0, (from_s - p->start_s) / p->duration_s),
                                    std::min(1.0, (to_s - p->start_s) / p->duration_s)),
                         kDegree);
            const Bezier own = restricted(fit, (from_s - at_s_) / length_s, (to_s - at_s_) / length_s);
            Bezier off = own;
            for (std::size_t k = 0; k <= kDegree; ++k) off.control[k] -= exact.control[k];
            const double stretch_s = to_s - from_s;
            for (const Vec3& d : off.controls()) error.position_m = std::max(error.position_m, glm::length(d));
            const Bezier speed = derivative(off), bend = derivative(derivative(own));
            for (const Vec3& d : speed.controls())
                error.speed_mps = std::max(error.speed_mps, glm::length(d) / stretch_s);
            for (const Vec3& d : bend.controls())
                peak_mps2 = std::max(peak_mps2, glm::length(d) / (stretch_s * stretch_s));
            from_s = to_s;
        }
        error.acceleration_mps2 = std::max(0.0, peak_mps2 - allowed_mps2_);
        return error;
    }

    /// Linear, as yaw is between its keys.
    void set_yaw(SepticPiece& piece) const {
        const double t = static_cast<double>(piece.duration_s);
        const double early = yaw_at(yaw_, at_s_ + 0.25 * t), late = yaw_at(yaw_, at_s_ + 0.75 * t);
        const double rate = (late - early) / (0.5 * t);
        piece.yaw[0] = static_cast<float>(early - 0.25 * t * rate);
        piece.yaw[1] = static_cast<float>(rate);
    }

    const Flight& flight_;
    const std::vector<YawKey>& yaw_;
    FlightCursor cursor_;
    FitError bound_;
    double allowed_mps2_;
    SepticFit result_;
    double at_s_ = 0.0;
};

}  // namespace

SepticFit septic_fit(const Flight& flight, const std::vector<YawKey>& yaw, const Limits& limits) {
    const std::vector<Span> spans = spans_of(flight, yaw);
    const double allowed_mps2 = std::max(limits.acceleration_mps2, largest_acceleration_mps2(flight));
    SepticFit best;
    for (const double aim_m : kAims_m) {
        FitError bound = fit_bound(limits);
        bound.position_m = std::min(bound.position_m, aim_m);
        best = Fitter(flight, yaw, bound, allowed_mps2).fit(spans);
        if (best.pieces.size() <= kCrazyfliePieces && best.error.within(bound)) break;
    }
    return best;
}

}  // namespace aerogram::exporter
