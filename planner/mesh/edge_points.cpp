#include "planner/mesh/edge_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>

#include "geo/contract.hpp"
#include "planner/sampling/edge_placing.hpp"

namespace aerogram::planner {
namespace {

// Shares of a step: a point that near to an earlier one is left out; those that can slide may begin nearer.
constexpr double kCornersApart = 0.85, kSlidersApart = 0.6;
constexpr double kTooMany = 4.0;                   ///< times what may be: then nearness does not thin them out enough
constexpr double kShortest = 0.96;                 ///< steps may be this share of a step to divide a line equally
constexpr std::size_t kFarthestWork = 30'000'000;  ///< corners x points up to which the farthest are sought

/// Places that keep a distance from each other, by cubes.
class Accepted {
  public:
    /// @param distance  at most this is asked for.
    explicit Accepted(double distance) : distance_(distance) {}

    bool accept(const Vec3& p, double apart) {
        const Cell cell{at(p.x), at(p.y), at(p.z)};
        for (long long x = -1; x <= 1; ++x) {
            for (long long y = -1; y <= 1; ++y) {
                for (long long z = -1; z <= 1; ++z) {
                    const auto found = cells_.find({cell[0] + x, cell[1] + y, cell[2] + z});
                    if (found == cells_.end()) continue;
                    for (const Vec3& q : found->second) {
                        if (glm::distance(p, q) < apart) return false;
                    }
                }
            }
        }
        cells_[cell].push_back(p);
        return true;
    }

  private:
    using Cell = std::array<long long, 3>;
    [[nodiscard]] long long at(double v) const { return static_cast<long long>(std::floor(v / distance_)); }

    double distance_;
    std::map<Cell, Points> cells_;
};

/// `count` of the places: the first one, then always the one farthest from those taken.
Points farthest(const Points& places, std::size_t count) {
    Points taken;
    if (places.size() * count > kFarthestWork) {
        for (std::size_t k = 0; k < count; ++k) taken.push_back(places[k * places.size() / count]);
        return taken;
    }
    std::vector<double> distance(places.size(), std::numeric_limits<double>::infinity());
    std::size_t next = 0;
    while (taken.size() < count) {
        taken.push_back(places[next]);
        for (std::size_t i = 0; i < places.size(); ++i)
            distance[i] = std::min(distance[i], glm::distance(places[i], places[next]));
        next = static_cast<std::size_t>(std::max_element(distance.begin(), distance.end()) - distance.begin());
    }
    return taken;
}

}  // namespace

EdgePoints::EdgePoints(const TriangleMesh& mesh) : mesh_(mesh), edges_(sharp_edges_of(mesh)) {
}

void EdgePoints::measure_lines() {
    if (!tracks_.empty()) return;
    tracks_.reserve(edges_.lines.size());
    for (const SharpLine& line : edges_.lines) tracks_.emplace_back(mesh_, line);
}

void EdgePoints::clear() {
    points_.clear();
    sliders_.clear();
}

void EdgePoints::add(const Vec3& at, std::optional<Slider> slider) {
    points_.push_back(at);
    sliders_.push_back(slider);
}

void EdgePoints::place_by_step(double step, bool lines, std::size_t most) {
    clear();
    const double bearable = kTooMany * static_cast<double>(most);
    if (static_cast<double>(lines ? edges_.lines.size() : edges_.tips.size()) > bearable) return;
    if (lines) measure_lines();
    double wanted = 0.0;
    for (const LineTrack& track : tracks_) wanted += track.length() / step;
    if (lines && wanted > bearable) return;
    reach_ = 0.1 * step;
    Accepted accepted(kCornersApart * step);
    const auto stand = [&](const std::vector<std::uint32_t>& vertices) {
        for (const std::uint32_t v : vertices) {
            if (accepted.accept(mesh_.vertices[v], kCornersApart * step)) add(mesh_.vertices[v], std::nullopt);
        }
    };
    stand(edges_.tips);
    if (!lines) {
        if (points_.size() > most) clear();
        return;
    }
    stand(edges_.corners);
    for (std::size_t k = 0; k < tracks_.size(); ++k) {
        const LineTrack& track = tracks_[k];
        const double steps = std::max(std::floor(track.length() / (kShortest * step)), track.closed() ? 3.0 : 1.0);
        for (double n = track.closed() ? 0.0 : 1.0; n < steps; n += 1.0) {
            const double along = track.length() * n / steps;
            const Vec3 at = track.at(along);
            if (accepted.accept(at, kSlidersApart * step)) add(at, Slider{k, along});
        }
    }
    if (points_.size() > most) clear();
}

double EdgePoints::place(std::size_t count) {
    AEROGRAM_REQUIRE(!none());
    clear();
    measure_lines();
    Points stations;
    std::vector<std::uint32_t> corners = edges_.tips;
    std::set_difference(edges_.corners.begin(), edges_.corners.end(), edges_.tips.begin(), edges_.tips.end(),
                        std::back_inserter(corners));
    for (const std::uint32_t v : corners) stations.push_back(mesh_.vertices[v]);
    double length = 0.0;
    for (const LineTrack& track : tracks_) {
        length += track.length();
        if (track.closed()) stations.push_back(track.at(0.0));
    }
    if (stations.size() > count) {
        for (const Vec3& station : farthest(stations, count)) add(station, std::nullopt);
    } else {
        const double apart = kSlidersApart * length / static_cast<double>(count);
        Accepted accepted(apart);
        for (const Vec3& station : stations) {
            if (accepted.accept(station, apart)) add(station, std::nullopt);
        }
    }
    std::vector<double> lengths;
    for (const LineTrack& track : tracks_) lengths.push_back(track.length());
    const std::vector<std::size_t> inside = points_inside(lengths, count - points_.size());
    double smallest = length;
    for (std::size_t k = 0; k < tracks_.size(); ++k) {
        const double step = lengths[k] / static_cast<double>(inside[k] + 1);
        if (inside[k] > 0) smallest = std::min(smallest, step);
        for (std::size_t n = 1; n <= inside[k]; ++n) {
            const double along = step * static_cast<double>(n);
            add(tracks_[k].at(along), Slider{k, along});
        }
    }
    reach_ = 0.1 * smallest;
    return smallest;
}

Freedom EdgePoints::freedom(std::size_t i) const {
    const auto& slider = sliders_[i];
    if (!slider) return {Freedom::Kind::none, {}};
    const LineTrack& track = tracks_[slider->line];
    const Vec3 ahead = track.at(slider->along + reach_) - track.at(slider->along - reach_);
    const double length = glm::length(ahead);
    if (length <= 0.0) return {Freedom::Kind::none, {}};
    return {Freedom::Kind::line, ahead / length};
}

Vec3 EdgePoints::move(std::size_t i, const Vec3& wanted) {
    const Freedom freedom = this->freedom(i);
    if (freedom.kind != Freedom::Kind::line) return points_[i];
    Slider& slider = *sliders_[i];
    slider.along += glm::dot(wanted - points_[i], freedom.axis);
    const LineTrack& track = tracks_[slider.line];
    if (!track.closed()) slider.along = std::clamp(slider.along, 0.0, track.length());
    return points_[i] = track.at(slider.along);
}

}  // namespace aerogram::planner
