#include "export/outgoing/piecewise_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "export/outgoing/curve_fit.hpp"
#include "geo/contract.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

using Cubic = std::array<Vec3, 4>;

constexpr double kStill_m = 1e-9;
constexpr double kSamePlace_m = 1e-6;
constexpr double kWholeMs = 1e-3;    ///< ms by which a time may miss a whole one
constexpr double kAverage_s = 0.25;  ///< velocities of lines in time are averaged over no more to either side
constexpr double kNever = std::numeric_limits<double>::infinity();

Millis up(double t_s) {
    return static_cast<Millis>(std::ceil(t_s * 1000.0 - kWholeMs));
}
Millis down(double t_s) {
    return static_cast<Millis>(std::floor(t_s * 1000.0 + kWholeMs));
}
bool whole_ms(double t_s) {
    return std::abs(t_s * 1000.0 - std::round(t_s * 1000.0)) <= kWholeMs;
}

/// Stretches between two times, of some of the flight's pieces.
struct Section {
    std::size_t first = 0, last = 0;  ///< pieces [first, last)
    Millis from_ms = 0, to_ms = 0;
    bool stands = false;
};

struct Misfit {
    double position_m = 0.0, speed_mps = 0.0, exact_peak_mps2 = 0.0, fit_peak_mps2 = 0.0;
};

Vec3 blossom(const Cubic& c, double a, double b, double d) {
    const auto lerp = [](const Vec3& p, const Vec3& q, double t) { return p + t * (q - p); };
    const Vec3 p0 = lerp(c[0], c[1], a), p1 = lerp(c[1], c[2], a), p2 = lerp(c[2], c[3], a);
    return lerp(lerp(p0, p1, b), lerp(p1, p2, b), d);
}
Cubic part(const Cubic& c, double a, double b) {
    return {blossom(c, a, a, a), blossom(c, a, a, b), blossom(c, a, b, b), blossom(c, b, b, b)};
}
Bezier bezier_of(const Cubic& c) {
    Bezier curve;
    curve.degree = 3;
    std::ranges::copy(c, curve.control.begin());
    return curve;
}

double peak_mps2(const Cubic& c, double duration_s) {
    const double factor = 6.0 / (duration_s * duration_s);
    return factor * std::max(glm::length(c[0] - 2.0 * c[1] + c[2]), glm::length(c[1] - 2.0 * c[2] + c[3]));
}

/// How far v is from the straight line between 0 and jump.
double beyond(const Vec3& v, const Vec3& jump) {
    const double length2 = glm::dot(jump, jump);
    const double share = length2 > 0.0 ? std::clamp(glm::dot(v, jump) / length2, 0.0, 1.0) : 0.0;
    return glm::length(v - share * jump);
}

class Fitter {
  public:
    Fitter(const Flight& flight, Millis duration_ms, const Limits& limits)
        : flight_(flight), duration_ms_(duration_ms), aim_(fit_aim(limits)), limit_mps2_(limits.acceleration_mps2) {
        note_jumps();
    }

    Fitted fit() {
        for (const Section& section : sections()) {
            if (section.stands) {
                const Vec3 place = control(section.first, 0);
                result_.pieces.push_back(
                    {section.from_ms, section.to_ms - section.from_ms, true, {place, place, place, place}});
            } else if (passes(section)) {
                for (std::size_t k = section.first; k < section.last; ++k) {
                    const Millis from_ms = std::llround(start_s(k) * 1000.0);
                    const Millis to_ms = k + 1 < section.last ? std::llround(start_s(k + 1) * 1000.0) : section.to_ms;
                    result_.pieces.push_back({from_ms, to_ms - from_ms, false, cubic(k)});
                }
            } else {
                refit(section);
            }
        }
        return std::move(result_);
    }

  private:
    [[nodiscard]] std::size_t count() const { return flight_.pieces.size(); }
    [[nodiscard]] double start_s(std::size_t k) const { return flight_.pieces[k].start_s; }
    [[nodiscard]] double end_s(std::size_t k) const {
        return k + 1 < count() ? start_s(k + 1) : std::max(seconds_from_ms(duration_ms_), start_s(k) + 1e-6);
    }
    [[nodiscard]] const Vec3& control(std::size_t k, std::size_t c) const {
        return flight_.controls_m[flight_.pieces[k].first_control + c];
    }
    [[nodiscard]] Bezier curve(std::size_t k) const {
        Bezier result;
        result.degree = flight_.pieces[k].degree;
        for (std::size_t c = 0; c <= result.degree; ++c) result.control[c] = control(k, c);
        return result;
    }
    [[nodiscard]] Cubic cubic(std::size_t k) const {
        const Bezier raised = elevated(curve(k), 3);
        return {raised.control[0], raised.control[1], raised.control[2], raised.control[3]};
    }
    [[nodiscard]] Vec3 velocity(std::size_t k, double t_s) const {
        const Piece& piece = flight_.pieces[k];
        return value(derivative(curve(k)), (t_s - piece.start_s) / piece.duration_s) / piece.duration_s;
    }
    [[nodiscard]] bool still(std::size_t k) const {
        for (std::size_t c = 1; c <= flight_.pieces[k].degree; ++c)
            if (glm::length(control(k, c) - control(k, 0)) > kStill_m) return false;
        return true;
    }

    /// How the velocity changes where piece k begins; places that jump are misses of the fit.
    void note_jumps() {
        jumps_mps_.assign(count() + 1, Vec3{});
        for (std::size_t k = 1; k < count(); ++k) {
            const Vec3 before = velocity(k - 1, start_s(k)), after = velocity(k, start_s(k));
            if (glm::length(after - before) > kStill_m) jumps_mps_[k] = after - before;
            const Bezier last = curve(k - 1);
            const double u = (start_s(k) - start_s(k - 1)) / flight_.pieces[k - 1].duration_s;
            const double jump_m = glm::length(control(k, 0) - value(last, u));
            if (jump_m > kSamePlace_m) result_.error.position_m = std::max(result_.error.position_m, jump_m);
        }
    }

    [[nodiscard]] std::vector<Section> sections() const {
        std::vector<Section> found;
        Millis now_ms = 0;
        std::size_t moving = 0;  // the first piece that belongs to no section yet
        const auto close = [&](std::size_t last, Millis until_ms) {
            if (until_ms > now_ms) found.push_back({moving, std::max(last, moving + 1), now_ms, until_ms, false});
            now_ms = until_ms;
        };
        for (std::size_t k = 0; k < count();) {
            std::size_t end = k;
            while (end < count() && still(end) && glm::length(control(end, 0) - control(k, 0)) <= kStill_m) ++end;
            if (end == k) {
                ++k;
                continue;
            }
            const Millis from_ms = k == 0 ? 0 : up(start_s(k));
            const Millis to_ms = end == count() ? duration_ms_ : down(start_s(end));
            if (to_ms - from_ms >= kShortestPieceMs || (k == 0 && end == count())) {
                close(k, from_ms);
                found.push_back({k, end, from_ms, to_ms, true});
                now_ms = to_ms;
                moving = end;
            }
            k = end;
        }
        if (moving == count()) moving = count() - 1;
        close(count(), duration_ms_);
        return found;
    }

    [[nodiscard]] bool passes(const Section& section) const {
        if (std::abs(start_s(section.first) * 1000.0 - static_cast<double>(section.from_ms)) > kWholeMs) return false;
        if (std::abs(end_s(section.last - 1) * 1000.0 - static_cast<double>(section.to_ms)) > kWholeMs) return false;
        for (std::size_t k = section.first; k < section.last; ++k) {
            const double shortest_s = seconds_from_ms(kShortestPieceMs) - 1e-6;
            const double length_s = end_s(k) - start_s(k);
            if (flight_.pieces[k].degree > 3 || !whole_ms(start_s(k)) || length_s < shortest_s) return false;
            if (std::abs(length_s - flight_.pieces[k].duration_s) > 1e-5) return false;
            if (glm::length(jumps_mps_[k]) > kSameSpeed_mps) return false;
        }
        return glm::length(jumps_mps_[section.last]) <= kSameSpeed_mps;
    }

    [[nodiscard]] std::size_t piece_at(double t_s) const {
        const auto after = std::ranges::upper_bound(flight_.pieces, t_s, {}, &Piece::start_s);
        return after == flight_.pieces.begin() ? 0 : static_cast<std::size_t>(after - flight_.pieces.begin()) - 1;
    }
    [[nodiscard]] Vec3 place(double t_s) const {
        const std::size_t k = piece_at(t_s);
        const Piece& piece = flight_.pieces[k];
        return value(curve(k), std::clamp((t_s - piece.start_s) / piece.duration_s, 0.0, 1.0));
    }
    /// The velocity that the fit takes at a time within a section.
    [[nodiscard]] Vec3 fit_velocity(const Section& section, Millis time_ms) const {
        const bool begins = time_ms == section.from_ms, ends = time_ms == section.to_ms;
        if ((begins && section.from_ms > 0) || (ends && section.to_ms < duration_ms_)) return Vec3{};  // beside a stand
        const double t_s = seconds_from_ms(time_ms);
        const std::size_t k = piece_at(t_s);
        if (begins || ends) return velocity(begins ? k : section.last - 1, t_s);
        if (flight_.pieces[k].degree <= 1) {
            const double reach_s =
                std::min({kAverage_s, flight_.pieces[k].duration_s / 2.0, t_s - seconds_from_ms(section.from_ms),
                          seconds_from_ms(section.to_ms) - t_s});
            return (place(t_s + reach_s) - place(t_s - reach_s)) / (2.0 * reach_s);
        }
        const bool joint = k > 0 && t_s - start_s(k) < 1e-9;
        return joint ? velocity(k, t_s) - 0.5 * jumps_mps_[k] : velocity(k, t_s);
    }

    void refit(const Section& section) {
        const Millis length_ms = section.to_ms - section.from_ms;
        const Millis most = std::max<Millis>(1, length_ms / kShortestPieceMs);
        FitError error;
        std::vector<FittedPiece> pieces;
        for (Millis n = 1; n <= most;) {
            const bool last = n == most;
            pieces = hermite_pieces(section, n);
            const Misfit misfit = measured(section, pieces, last ? kNever : aim_.position_m);
            const double allowed_mps2 = std::max(misfit.exact_peak_mps2, limit_mps2_);
            error = {misfit.position_m, misfit.speed_mps, std::max(0.0, misfit.fit_peak_mps2 - allowed_mps2)};
            if (last || error.within(aim_)) break;
            const bool power = (n & (n - 1)) == 0;
            n = std::min(most, n < 2 ? 2 : power ? n + n / 2 : n / 3 * 4);
        }
        result_.pieces.insert(result_.pieces.end(), pieces.begin(), pieces.end());
        result_.error.position_m = std::max(result_.error.position_m, error.position_m);
        result_.error.speed_mps = std::max(result_.error.speed_mps, error.speed_mps);
        result_.error.acceleration_mps2 = std::max(result_.error.acceleration_mps2, error.acceleration_mps2);
    }

    [[nodiscard]] std::vector<FittedPiece> hermite_pieces(const Section& section, Millis n) const {
        const Millis length_ms = section.to_ms - section.from_ms;
        std::vector<FittedPiece> pieces;
        const auto bound = [&](Millis j) { return section.from_ms + (2 * j * length_ms + n) / (2 * n); };
        Vec3 from_m = place(seconds_from_ms(bound(0))), from_mps = fit_velocity(section, bound(0));
        for (Millis j = 0; j < n; ++j) {
            const Millis a = bound(j), b = bound(j + 1);
            const Vec3 to_m = place(seconds_from_ms(b)), to_mps = fit_velocity(section, b);
            const double third_s = seconds_from_ms(b - a) / 3.0;
            pieces.push_back({a, b - a, false, {from_m, from_m + third_s * from_mps, to_m - third_s * to_mps, to_m}});
            from_m = to_m, from_mps = to_mps;
        }
        return pieces;
    }

    /// Bounds what the pieces miss by. @param give_up_m  a misfit beyond this ends the measurement.
    [[nodiscard]] Misfit measured(const Section& section, const std::vector<FittedPiece>& pieces,
                                  double give_up_m) const {
        Misfit misfit;
        for (std::size_t k = section.first; k < section.last; ++k) {
            const Piece& piece = flight_.pieces[k];
            if (piece.degree >= 2 && piece.degree <= 3)
                misfit.exact_peak_mps2 = std::max(misfit.exact_peak_mps2, peak_mps2(cubic(k), piece.duration_s));
        }
        std::size_t k = piece_at(seconds_from_ms(section.from_ms));
        for (const FittedPiece& fit : pieces) {
            const double from_s = seconds_from_ms(fit.start_ms), length_s = seconds_from_ms(fit.duration_ms);
            misfit.fit_peak_mps2 = std::max(misfit.fit_peak_mps2, peak_mps2(fit.controls_m, length_s));
            for (double at_s = from_s; at_s < from_s + length_s;) {
                const double piece_end_s = k + 1 < count() ? start_s(k + 1) : kNever;
                const double to_s = std::min(from_s + length_s, piece_end_s);
                if (to_s - at_s > 1e-9) widen(misfit, k, at_s, to_s, fit);
                if (misfit.position_m > give_up_m) return misfit;
                at_s = to_s;
                if (to_s == piece_end_s) ++k;
            }
        }
        return misfit;
    }

    /// One stretch on which flight and fit are one polynomial each; beside jumps of the speed in halves.
    void widen(Misfit& misfit, std::size_t k, double at_s, double to_s, const FittedPiece& fit) const {
        const Vec3 &jump_in = jumps_mps_[k], &jump_out = jumps_mps_[k + 1];
        const double middle_s = 0.5 * (start_s(k) + end_s(k));
        if ((jump_in == Vec3{} && jump_out == Vec3{}) || middle_s <= at_s || middle_s >= to_s) {
            compare(misfit, k, at_s, to_s, fit, middle_s >= to_s ? -jump_in : jump_out);
        } else {
            compare(misfit, k, at_s, middle_s, fit, -jump_in);
            compare(misfit, k, middle_s, to_s, fit, jump_out);
        }
    }

    void compare(Misfit& misfit, std::size_t k, double at_s, double to_s, const FittedPiece& fit,
                 const Vec3& jump_mps) const {
        const Piece& piece = flight_.pieces[k];
        const double from_s = seconds_from_ms(fit.start_ms), length_s = seconds_from_ms(fit.duration_ms);
        const Cubic fitted = part(fit.controls_m, (at_s - from_s) / length_s, (to_s - from_s) / length_s);
        const double u = (at_s - piece.start_s) / piece.duration_s, v = (to_s - piece.start_s) / piece.duration_s;
        Bezier difference;
        if (piece.degree <= 3) {
            const Cubic exact = part(cubic(k), u, v);
            difference.degree = 3;
            for (std::size_t c = 0; c < 4; ++c) difference.control[c] = fitted[c] - exact[c];
        } else {
            const Bezier exact = restricted(curve(k), std::max(u, 0.0), std::max(v, 1e-12));
            difference = elevated(bezier_of(fitted), exact.degree);
            for (std::size_t c = 0; c <= exact.degree; ++c) difference.control[c] -= exact.control[c];
        }
        for (const Vec3& d : difference.controls()) misfit.position_m = std::max(misfit.position_m, glm::length(d));
        for (std::size_t c = 0; c < difference.degree; ++c) {
            const Vec3 speed = static_cast<double>(difference.degree) *
                               (difference.control[c + 1] - difference.control[c]) / (to_s - at_s);
            misfit.speed_mps = std::max(misfit.speed_mps, beyond(speed, jump_mps));
        }
    }

    const Flight& flight_;
    Millis duration_ms_;
    FitError aim_;
    double limit_mps2_;
    std::vector<Vec3> jumps_mps_;  ///< where piece k begins; [count] is zero
    Fitted result_;
};

}  // namespace

Fitted piecewise_fit(const Flight& flight, Millis duration_ms, const Limits& limits) {
    AEROGRAM_REQUIRE(!flight.pieces.empty() && duration_ms > 0, duration_ms);
    return Fitter(flight, duration_ms, limits).fit();
}

}  // namespace aerogram::exporter
