#include <algorithm>
#include <array>

#include "export/record/bezier.hpp"
#include "export/skybrush/skyb_layout.hpp"
#include "export/skybrush/skyb_trajectory.hpp"
#include "export/skybrush/skybrush_frame.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

/// One axis of a segment: its control values, the first of which is where the segment before ended.
struct AxisCurve {
    std::array<double, kMaxDegree + 1> value{};
    std::size_t degree = 0;
};

AxisCurve read_axis(ByteCursor& in, unsigned form, double start, double unit) {
    constexpr std::array<std::size_t, 4> kDegrees{0, 1, 3, 7};
    AxisCurve curve;
    curve.degree = kDegrees[form];
    curve.value[0] = start;
    for (std::size_t c = 1; c <= curve.degree; ++c) curve.value[c] = in.number<std::int16_t>() * unit;
    return curve;
}

/// The same polynomial with a higher degree.
void raise(AxisCurve& curve, std::size_t degree) {
    while (curve.degree < degree) {
        const auto next = static_cast<double>(curve.degree + 1);
        curve.value[curve.degree + 1] = curve.value[curve.degree];
        for (std::size_t c = curve.degree; c > 0; --c) {
            const double share = static_cast<double>(c) / next;
            curve.value[c] = share * curve.value[c - 1] + (1.0 - share) * curve.value[c];
        }
        ++curve.degree;
    }
}

double value_at(const AxisCurve& curve, double u) {
    auto p = curve.value;
    for (std::size_t left = curve.degree; left > 0; --left)
        for (std::size_t c = 0; c < left; ++c) p[c] = (1.0 - u) * p[c] + u * p[c + 1];
    return p[0];
}

class TrajectoryReader {
  public:
    TrajectoryReader(ByteCursor& in, RecordedDrone& drone) : in_(in), drone_(drone) {}

    ReadSkybTrajectory read() {
        const auto scale = in_.number<std::uint8_t>();
        yaw_inside_ = (scale & skyb::kYawInside) != 0;
        result_.scale_mm = scale & 0x7F;
        if (in_.ok() && result_.scale_mm == 0) in_.complain("an empty trajectory: its scale is 0", 1);
        unit_m_ = result_.scale_mm / 1000.0;
        for (double& coordinate : at_) coordinate = in_.number<std::int16_t>() * unit_m_;
        yaw_deg_ = in_.number<std::int16_t>() * 0.1;
        add_yaw(0, yaw_deg_);
        drone_.controls_m.push_back(place());
        while (in_.ok() && in_.left() > 0) segment();
        if (drone_.pieces.empty() && in_.ok()) drone_.pieces.push_back({0.0, 1.0, 0, 0});
        note_jump({}, false);
        return result_;
    }

  private:
    [[nodiscard]] Vec3 place() const { return from_skybrush({at_[0], at_[1], at_[2]}); }

    void add_yaw(Millis time_ms, double yaw_deg) {
        if (yaw_inside_) drone_.tracks.yaw.push_back({time_ms, -radians(yaw_deg)});
    }

    void segment() {
        const auto format = in_.number<std::uint8_t>();
        const Millis duration_ms = in_.number<std::uint16_t>();
        std::array<AxisCurve, 3> axes;
        std::size_t degree = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            axes[axis] = read_axis(in_, (format >> (2 * axis)) & 3U, at_[axis], unit_m_);
            degree = std::max(degree, axes[axis].degree);
        }
        const AxisCurve yaw = read_axis(in_, (format >> 6U) & 3U, yaw_deg_, 0.1);
        if (!in_.ok()) return;
        turn(yaw, duration_ms);
        if (duration_ms > 0) add_piece(axes, degree, duration_ms);
        for (std::size_t axis = 0; axis < 3; ++axis) at_[axis] = axes[axis].value[axes[axis].degree];
        if (duration_ms == 0 && degree > 0) drone_.controls_m.push_back(place());
        time_ms_ += duration_ms;
    }

    void turn(const AxisCurve& yaw, Millis duration_ms) {
        const int steps = yaw.degree > 1 ? 8 : 1;
        for (int k = 1; k <= steps; ++k) add_yaw(time_ms_ + duration_ms * k / steps, value_at(yaw, double(k) / steps));
        yaw_deg_ = yaw.value[yaw.degree];
    }

    void add_piece(std::array<AxisCurve, 3>& axes, std::size_t degree, Millis duration_ms) {
        const double duration_s = seconds_from_ms(duration_ms), d = static_cast<double>(degree);
        const auto first = static_cast<std::uint32_t>(drone_.controls_m.size() - 1);
        for (AxisCurve& axis : axes) raise(axis, degree);
        for (std::size_t c = 1; c <= degree; ++c)
            drone_.controls_m.push_back(from_skybrush({axes[0].value[c], axes[1].value[c], axes[2].value[c]}));
        drone_.pieces.push_back({seconds_from_ms(time_ms_), duration_s, first, static_cast<std::uint8_t>(degree)});
        note_factors(degree, duration_s);
        const Vec3* const c = &drone_.controls_m[first];
        const double rate = d / duration_s;
        note_jump(degree == 0 ? Vec3{} : rate * (c[1] - c[0]), degree == 1);
        velocity_mps_ = degree == 0 ? Vec3{} : rate * (c[degree] - c[degree - 1]);
    }

    /// A straight piece may have been a cubic before it was rounded.
    void note_factors(std::size_t degree, double duration_s) {
        if (degree == 0) return;
        const auto d = static_cast<double>(std::max<std::size_t>(degree, 3));
        result_.speed_factor = std::max(result_.speed_factor, 2.0 * d / duration_s);
        result_.acceleration_factor =
            std::max(result_.acceleration_factor, 4.0 * d * (d - 1.0) / (duration_s * duration_s));
    }

    /// Between the piece before, or rest, and one that begins with this velocity.
    void note_jump(const Vec3& velocity_mps, bool straight) {
        if (straight || was_straight_)
            result_.linear_jump_mps = std::max(result_.linear_jump_mps, glm::length(velocity_mps - velocity_mps_));
        was_straight_ = straight;
    }

    ByteCursor& in_;
    RecordedDrone& drone_;
    ReadSkybTrajectory result_;
    double unit_m_ = 0.0, yaw_deg_ = 0.0;
    std::array<double, 3> at_{};
    Millis time_ms_ = 0;
    bool yaw_inside_ = false, was_straight_ = false;
    Vec3 velocity_mps_{};
};

}  // namespace

ReadSkybTrajectory read_skyb_trajectory(ByteCursor& in, RecordedDrone& drone) {
    return TrajectoryReader(in, drone).read();
}

}  // namespace aerogram::exporter
