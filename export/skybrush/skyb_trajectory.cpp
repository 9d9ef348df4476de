#include "export/skybrush/skyb_trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "export/record/bezier.hpp"
#include "export/skybrush/skyb.hpp"
#include "export/skybrush/skyb_layout.hpp"
#include "export/skybrush/skybrush_frame.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

constexpr double kLargestUnits = 32'767.0;
using Units = std::array<std::int64_t, 3>;
using Controls = std::array<Vec3, 4>;

Error infeasible(std::string what) {
    return {ErrorCode::infeasible, std::move(what)};
}

/// How an axis must be written so that nothing is lost, from its four control values.
skyb::Axis form_of(std::int64_t a, std::int64_t b, std::int64_t c, std::int64_t d) {
    if (a == b && a == c && a == d) return skyb::constant;
    if (3 * (b - a) == d - a && 3 * (c - a) == 2 * (d - a)) return skyb::linear;
    return skyb::cubic;
}

/// Segment after segment in whole units.
class Encoder {
  public:
    Encoder(int scale_mm, const Vec3& start_m) : per_m_(1000.0 / scale_mm), at_(units(start_m)), start_z_(at_[2]) {
        result_.scale_mm = scale_mm;
        put(result_.body, static_cast<std::uint8_t>(scale_mm));
        for (const std::int64_t value : at_) put(result_.body, static_cast<std::int16_t>(value));
        put(result_.body, std::int16_t{0});
    }

    /// Stands until then.
    void hold(Millis until_ms) {
        while (time_ms_ < until_ms) {
            const Millis part_ms = std::min<Millis>(until_ms - time_ms_, skyb::kLongestSegmentMs);
            segment({at_, at_, at_}, part_ms);
        }
    }

    void fly(const FittedPiece& piece) {
        const Millis parts = (piece.duration_ms + skyb::kLongestSegmentMs - 1) / skyb::kLongestSegmentMs;
        if (parts <= 1) return cubic(piece.controls_m, piece.duration_ms);
        Bezier whole;
        whole.degree = 3;
        std::ranges::copy(piece.controls_m, whole.control.begin());
        Millis from_ms = 0;
        for (Millis part = 1; part <= parts; ++part) {
            const Millis to_ms = piece.duration_ms * part / parts;
            const auto share = [&](Millis t) {
                return static_cast<double>(t) / static_cast<double>(piece.duration_ms);
            };
            const Bezier cut = restricted(whole, share(from_ms), share(to_ms));
            cubic({cut.control[0], cut.control[1], cut.control[2], cut.control[3]}, to_ms - from_ms);
            from_ms = to_ms;
        }
    }

    /// Units from where the last segment ended to this place, the largest axis.
    [[nodiscard]] std::int64_t units_to(const Vec3& show_m) const {
        const Units to = units(show_m);
        std::int64_t most = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) most = std::max(most, std::abs(to[axis] - at_[axis]));
        return most;
    }
    [[nodiscard]] Millis time_ms() const { return time_ms_; }
    SkybTrajectory finished() && { return std::move(result_); }

  private:
    [[nodiscard]] Units units(const Vec3& show_m) const {
        const Vec3 p = to_skybrush(show_m);
        return {std::llround(p.x * per_m_), std::llround(p.y * per_m_), std::llround(p.z * per_m_)};
    }

    void cubic(const Controls& controls_m, Millis duration_ms) {
        segment({units(controls_m[1]), units(controls_m[2]), units(controls_m[3])}, duration_ms);
    }

    void segment(const std::array<Units, 3>& controls, Millis duration_ms) {
        std::array<skyb::Axis, 3> forms{};
        unsigned format = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            forms[axis] = form_of(at_[axis], controls[0][axis], controls[1][axis], controls[2][axis]);
            format |= static_cast<unsigned>(forms[axis]) << (2 * axis);
        }
        std::string& body = result_.body;
        put(body, static_cast<std::uint8_t>(format));
        put(body, static_cast<std::uint16_t>(duration_ms));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t first = forms[axis] == skyb::constant ? 3 : forms[axis] == skyb::linear ? 2 : 0;
            for (std::size_t c = first; c < 3; ++c) put(body, static_cast<std::int16_t>(controls[c][axis]));
        }
        result_.moves = result_.moves || format != 0;
        at_ = controls[2];
        time_ms_ += duration_ms;
        result_.rise_m = std::max(result_.rise_m, static_cast<double>(at_[2] - start_z_) / per_m_);
    }

    double per_m_;
    Units at_;
    std::int64_t start_z_;
    Millis time_ms_ = 0;
    SkybTrajectory result_;
};

}  // namespace

int skyb_scale_mm(const Fitted& fitted) {
    double farthest_m = 0.0;
    for (const FittedPiece& piece : fitted.pieces)
        for (const Vec3& p : piece.controls_m)
            farthest_m = std::max({farthest_m, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    const double scale = std::ceil(farthest_m * 1000.0 / (kLargestUnits + 0.499));
    return static_cast<int>(std::clamp(scale, 1.0, 1e6));
}

Result<SkybTrajectory> skyb_trajectory(const Fitted& fitted, Millis duration_ms) {
    AEROGRAM_REQUIRE(!fitted.pieces.empty());
    const int scale_mm = skyb_scale_mm(fitted);
    if (scale_mm > kSkybLargestScale)
        return infeasible("goes farther than " + std::to_string(kSkybLargestScale * 32'767 / 1000) +
                          " m from the origin along an axis, which 16 bits cannot hold");
    Encoder out(scale_mm, fitted.pieces.front().controls_m[0]);
    for (const FittedPiece& piece : fitted.pieces) {
        out.hold(piece.start_ms);
        if (out.units_to(piece.controls_m[0]) > 1)
            return infeasible("jumps at " + std::to_string(piece.start_ms) + " ms");
        if (piece.stands) {
            out.hold(piece.start_ms + piece.duration_ms);
        } else {
            out.fly(piece);
        }
    }
    out.hold(duration_ms);
    if (out.time_ms() != duration_ms) return infeasible("flies on after the show's end");
    SkybTrajectory result = std::move(out).finished();
    if (result.body.size() > skyb::kLargestBlock)
        return infeasible("its trajectory takes " + std::to_string(result.body.size()) + " bytes; a block holds " +
                          std::to_string(skyb::kLargestBlock));
    return result;
}

}  // namespace aerogram::exporter
