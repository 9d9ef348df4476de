#include "planner/sampling/slide_apart.hpp"

#include <algorithm>
#include <cmath>
#include <compare>
#include <limits>
#include <optional>
#include <utility>

#include "geo/random.hpp"
#include "planner/sampling/contour_track.hpp"
#include "planner/sampling/push_apart.hpp"
#include "planner/sampling/site_grid.hpp"

namespace aerogram::planner {
namespace {

constexpr double kLast = 0.4;   ///< the last target, a share of the ideal
constexpr double kStep = 0.45;  ///< share of an overlap that one point yields
constexpr double kOnIt = 1e-6;  ///< shares of the ideal: nearer is on the contour, or at the corner
constexpr std::size_t kBandsAtMost = 4096;
constexpr double kCornersApart = 0.25;  ///< likewise: a corner that near to an earlier one does not hold its point

/// A point that can slide.
struct Slider {
    std::size_t contour = 0;
    double along = 0.0;
};

/// The contours' segments by level bands, so that those at a point's height are found at once.
class Segments {
  public:
    Segments(const Region& region, const std::vector<ContourTrack>& tracks) : region_(region), tracks_(tracks) {
        std::size_t count = 0;
        for (const Contour& contour : region.contours) count += contour.size();
        if (count == 0) return;
        const Bounds box = bounds_of(region);
        bands_.resize(std::clamp<std::size_t>(count / 4, 1, kBandsAtMost));
        low_ = box.low.y;
        height_ = std::max(box.size().y, 1e-300) / static_cast<double>(bands_.size());
        for (std::size_t c = 0; c < region.contours.size(); ++c) {
            const Contour& contour = region.contours[c];
            for (std::size_t i = 0; i < contour.size(); ++i) {
                const double y = contour[i].y, next = contour[(i + 1) % contour.size()].y;
                for (std::size_t b = band(std::min(y, next)); b <= band(std::max(y, next)); ++b)
                    bands_[b].push_back({c, i});
            }
        }
    }

    /// The first segment that p lies on, to `close`.
    [[nodiscard]] std::optional<Slider> at(const Vec2& p, double close) const {
        std::optional<Segment> first;
        for (std::size_t b = band(p.y - close); b <= band(p.y + close) && !bands_.empty(); ++b) {
            for (const Segment& segment : bands_[b]) {
                if (first && !(segment < *first)) break;
                if (distance(segment, p) <= close) first = segment;
            }
        }
        if (!first) return std::nullopt;
        const auto [a, d] = line(*first);
        return Slider{first->contour,
                      tracks_[first->contour].of_vertex(first->vertex) + share(a, d, p) * glm::length(d)};
    }

  private:
    struct Segment {
        std::size_t contour = 0, vertex = 0;
        auto operator<=>(const Segment&) const = default;
    };

    [[nodiscard]] std::size_t band(double y) const {
        const double most = static_cast<double>(bands_.size()) - 1.0;
        return static_cast<std::size_t>(std::clamp(std::floor((y - low_) / height_), 0.0, std::max(most, 0.0)));
    }
    [[nodiscard]] std::pair<Vec2, Vec2> line(const Segment& segment) const {
        const Contour& contour = region_.contours[segment.contour];
        const Vec2 a = contour[segment.vertex];
        return {a, contour[(segment.vertex + 1) % contour.size()] - a};
    }
    static double share(const Vec2& a, const Vec2& d, const Vec2& p) {
        return std::clamp(glm::dot(p - a, d) / glm::dot(d, d), 0.0, 1.0);
    }
    [[nodiscard]] double distance(const Segment& segment, const Vec2& p) const {
        const auto [a, d] = line(segment);
        if (glm::dot(d, d) <= 0.0) return std::numeric_limits<double>::infinity();
        return glm::distance(p, a + share(a, d, p) * d);
    }

    const Region& region_;
    const std::vector<ContourTrack>& tracks_;
    std::vector<std::vector<Segment>> bands_;  ///< each in the contours' order
    double low_ = 0.0, height_ = 1.0;
};

/// The points that may slide: on a contour, and not holding a corner.
std::vector<std::optional<Slider>> sliders_of(const Region& region, const std::vector<ContourTrack>& tracks,
                                              const std::vector<Vec2>& points, double ideal) {
    std::vector<Vec2> corners;
    for (const Contour& contour : region.contours) {
        for (const std::size_t i : corners_of(contour)) corners.push_back(contour[i]);
    }
    const SiteGrid corner_grid(corners, ideal), point_grid(points, kCornersApart * ideal);
    const Segments segments(region, tracks);
    std::vector<bool> held(points.size(), false);
    std::vector<std::optional<Slider>> out;
    for (std::size_t i = 0; i < points.size(); ++i) {
        bool at_corner = false, taken = false;
        corner_grid.near(points[i], 1, [&](std::size_t, const Vec2& corner) {
            at_corner = at_corner || glm::distance(points[i], corner) < kOnIt * ideal;
        });
        if (at_corner) {
            point_grid.near(points[i], 1, [&](std::size_t j, const Vec2& p) {
                taken = taken || (held[j] && glm::distance(points[i], p) < kCornersApart * ideal);
            });
        }
        held[i] = at_corner && !taken;
        out.push_back(held[i] ? std::nullopt : segments.at(points[i], kOnIt * ideal));
    }
    return out;
}

/// Where each point wants to go to be `target` away from the others.
std::vector<Vec2> pushes(const std::vector<Vec2>& points, double target) {
    std::vector<Vec2> out(points.size());
    const SiteGrid grid(points, target);
    for (std::size_t i = 0; i < points.size(); ++i) {
        grid.near(points[i], 1, [&](std::size_t j, const Vec2& q) {
            const Vec2 apart = points[i] - q;
            const double distance = glm::length(apart);
            if (j == i || distance >= target || distance <= 0.0) return;
            out[i] += kStep * (target - distance) / distance * apart;
        });
    }
    return out;
}

}  // namespace

std::vector<Vec2> slide_apart(const Region& region, std::vector<Vec2> points, double ideal, std::size_t rounds) {
    std::vector<ContourTrack> tracks;
    tracks.reserve(region.contours.size());
    for (const Contour& contour : region.contours) tracks.emplace_back(contour);
    std::vector<std::optional<Slider>> sliders = sliders_of(region, tracks, points, ideal);
    std::vector<Vec2> best = points;
    double best_distance = smallest_distance(points);
    for (std::size_t round = 0; round < rounds; ++round) {
        const double share = static_cast<double>(round) / static_cast<double>(rounds);
        const double target = ideal * (1.0 + (kLast - 1.0) * share);
        if (target < best_distance) break;  // nothing to win any more
        const std::vector<Vec2> push = pushes(points, target);
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (!sliders[i]) continue;
            const ContourTrack& track = tracks[sliders[i]->contour];
            const double step = 0.05 * target;
            const Vec2 ahead = track.at(sliders[i]->along + step) - track.at(sliders[i]->along - step);
            const double length = glm::length(ahead);
            if (length <= 0.0) continue;
            // Points face to face push each other nowhere along their lines: a little to either side first.
            if (round == 0 && push[i] != Vec2{}) sliders[i]->along += Random(i).between(-0.05, 0.05) * target;
            sliders[i]->along += std::clamp(glm::dot(push[i], ahead) / length, -0.3 * target, 0.3 * target);
            points[i] = track.at(sliders[i]->along);
        }
        const double now = smallest_distance(points);
        if (now <= best_distance) continue;
        best_distance = now;
        best = points;
    }
    return best;
}

}  // namespace aerogram::planner
