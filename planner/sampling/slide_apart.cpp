#include "planner/sampling/slide_apart.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "geo/random.hpp"
#include "planner/sampling/contour_track.hpp"
#include "planner/sampling/push_apart.hpp"
#include "planner/sampling/site_grid.hpp"

namespace aerogram::planner {
namespace {

constexpr double kLast = 0.4;           ///< the last target, a share of the ideal
constexpr double kStep = 0.45;          ///< share of an overlap that one point yields
constexpr double kOnIt = 1e-6;          ///< shares of the ideal: nearer is on the contour, or at the corner
constexpr double kCornersApart = 0.25;  ///< likewise: a corner that near to an earlier one does not hold its point

/// A point that can slide.
struct Slider {
    std::size_t contour = 0;
    double along = 0.0;
};

std::optional<Slider> slider_at(const Region& region, const std::vector<ContourTrack>& tracks, const Vec2& p,
                                double close) {
    for (std::size_t c = 0; c < region.contours.size(); ++c) {
        const Contour& contour = region.contours[c];
        for (std::size_t i = 0; i < contour.size(); ++i) {
            const Vec2 a = contour[i], d = contour[(i + 1) % contour.size()] - a;
            const double squared = glm::dot(d, d);
            if (squared <= 0.0) continue;
            const double share = std::clamp(glm::dot(p - a, d) / squared, 0.0, 1.0);
            if (glm::distance(p, a + share * d) > close) continue;
            return Slider{c, tracks[c].of_vertex(i) + share * glm::length(d)};
        }
    }
    return std::nullopt;
}

/// The points that may slide: on a contour, and not holding a corner.
std::vector<std::optional<Slider>> sliders_of(const Region& region, const std::vector<ContourTrack>& tracks,
                                              const std::vector<Vec2>& points, double ideal) {
    std::vector<Vec2> corners, held;
    for (const Contour& contour : region.contours) {
        for (const std::size_t i : corners_of(contour)) corners.push_back(contour[i]);
    }
    const auto near_any = [](const std::vector<Vec2>& places, const Vec2& p, double reach) {
        return std::any_of(places.begin(), places.end(), [&](const Vec2& q) { return glm::distance(p, q) < reach; });
    };
    std::vector<std::optional<Slider>> out;
    for (const Vec2& p : points) {
        const bool holds = near_any(corners, p, kOnIt * ideal) && !near_any(held, p, kCornersApart * ideal);
        if (holds) held.push_back(p);
        out.push_back(holds ? std::nullopt : slider_at(region, tracks, p, kOnIt * ideal));
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
