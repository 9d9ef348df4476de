#include <algorithm>
#include <cmath>
#include <limits>

#include "export/report/survey.hpp"

namespace aerogram::exporter {
namespace {

constexpr double kNothing = -std::numeric_limits<double>::infinity();

}  // namespace

SeriesMaker::SeriesMaker(const std::vector<double>& times_s, bool planes) : times_s_(times_s), planes_(planes) {
    Reach none;
    none.most.fill(0.0);
    none.most[altitude] = none.most[slow] = kNothing;
    most_.assign(times_s.size(), none);
}

/// The largest of the control points of the piece and of its derivatives, which no point exceeds; the slowest airspeed
/// is that at the piece's ends.
SeriesMaker::Reach SeriesMaker::reach(std::span<const Vec3> c, double duration_s, double home_z_m) const {
    Reach reach;
    reach.most[altitude] = kNothing;
    for (const Vec3& p : c) reach.most[altitude] = std::max(reach.most[altitude], p.z - home_z_m);
    const double degree = static_cast<double>(c.size() - 1), per_s = degree / duration_s;
    double ground2 = 0.0, fast2 = 0.0, acceleration2 = 0.0, jerk2 = 0.0;
    const auto velocity = [&](std::size_t i) { return per_s * (c[i + 1] - c[i]); };
    for (std::size_t i = 0; i + 1 < c.size(); ++i) {
        const Vec3 v = velocity(i);
        ground2 = std::max(ground2, v.x * v.x + v.y * v.y);
        fast2 = std::max(fast2, glm::dot(v, v));
        reach.most[up] = std::max(reach.most[up], v.z);
        reach.most[down] = std::max(reach.most[down], -v.z);
    }
    const double per_s2 = per_s * (degree - 1.0) / duration_s, per_s3 = per_s2 * (degree - 2.0) / duration_s;
    for (std::size_t i = 0; i + 2 < c.size(); ++i) {
        const Vec3 a = per_s2 * ((c[i + 2] - c[i + 1]) - (c[i + 1] - c[i]));
        acceleration2 = std::max(acceleration2, glm::dot(a, a));
    }
    for (std::size_t i = 0; i + 3 < c.size(); ++i) {
        const Vec3 j = per_s3 * ((c[i + 3] - c[i]) - 3.0 * (c[i + 2] - c[i + 1]));
        jerk2 = std::max(jerk2, glm::dot(j, j));
    }
    reach.most[horizontal] = std::sqrt(ground2);
    reach.most[acceleration] = std::sqrt(acceleration2);
    reach.most[jerk] = std::sqrt(jerk2);
    reach.most[fast] = std::sqrt(fast2);
    reach.most[slow] = c.size() < 2 ? 0.0 : -std::min(glm::length(velocity(0)), glm::length(velocity(c.size() - 2)));
    return reach;
}

void SeriesMaker::raise(std::size_t step, const Reach& by) {
    for (std::size_t q = 0; q < quantity_count; ++q) most_[step].most[q] = std::max(most_[step].most[q], by.most[q]);
}

void SeriesMaker::add(const RecordedDrone& drone, double home_z_m) {
    std::size_t step = 0;
    for (const Piece& piece : drone.pieces) {
        const std::span<const Vec3> controls(&drone.controls_m[piece.first_control], std::size_t{piece.degree} + 1);
        const double end_s = piece.start_s + piece.duration_s;
        while (step + 1 < times_s_.size() && times_s_[step + 1] <= piece.start_s + 1e-9) ++step;
        const bool cut =
            piece.degree > 0 && step + 1 < times_s_.size() && piece.duration_s > times_s_[step + 1] - times_s_[step];
        const Reach whole = reach(controls, piece.duration_s, home_z_m);
        for (std::size_t k = step; k < times_s_.size(); ++k) {
            if (k > step && times_s_[k] >= end_s - 1e-9) break;
            if (!cut || k + 1 == times_s_.size()) {
                raise(k, whole);
                continue;
            }
            const double from = std::clamp((times_s_[k] - piece.start_s) / piece.duration_s, 0.0, 1.0);
            const double to = std::clamp((times_s_[k + 1] - piece.start_s) / piece.duration_s, from, 1.0);
            if (!(to > from)) continue;
            const Bezier part = restricted(curve_of(drone, piece), from, to);
            raise(k, reach(part.controls(), (to - from) * piece.duration_s, home_z_m));
        }
    }
    Reach at_end;  // the last instant shows where the drone is then
    at_end.most.fill(kNothing);
    at_end.most[altitude] = last_position(drone).z - home_z_m;
    raise(times_s_.size() - 1, at_end);
}

void SeriesMaker::add(const SeriesMaker& other) {
    for (std::size_t k = 0; k < most_.size(); ++k) raise(k, other.most_[k]);
}

std::vector<ReportSeries> SeriesMaker::series(const Limits& limits) const {
    std::vector<ReportSeries> all;
    const auto add = [&](std::string name, std::string unit, Quantity quantity, std::optional<double> limit) {
        ReportSeries one{std::move(name), std::move(unit), {}, limit, {}};
        for (const Reach& r : most_) one.values.push_back(r.most[quantity]);
        all.push_back(std::move(one));
    };
    add("Highest altitude", "m", altitude, limits.ceiling_m);
    if (planes_ && limits.plane) {
        add("Highest airspeed", "m/s", fast, limits.plane->airspeed_max_mps);
        add("Lowest airspeed", "m/s", slow, {});
        for (double& v : all.back().values) v = std::isfinite(v) ? -v : 0.0;
        all.back().lower_limit = limits.plane->airspeed_min_mps;
        add("Climb", "m/s", up, limits.plane->climb_mps);
        add("Sink", "m/s", down, limits.plane->sink_mps);
    } else {
        add("Horizontal speed", "m/s", horizontal, limits.speed_horizontal_mps);
        add("Speed up", "m/s", up, limits.speed_up_mps);
        add("Speed down", "m/s", down, limits.speed_down_mps);
    }
    add("Acceleration", "m/s²", acceleration, limits.acceleration_mps2);
    add("Jerk", "m/s³", jerk, limits.jerk_mps3);
    return all;
}

}  // namespace aerogram::exporter
