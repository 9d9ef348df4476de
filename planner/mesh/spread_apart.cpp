#include "planner/mesh/spread_apart.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geo/random.hpp"
#include "planner/sampling/site_grid.hpp"

namespace aerogram::planner {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kFirst = 1.08,
                 kLast = 0.80;  ///< targets, shares of the gap that three quarters of the points have not
constexpr double kStep = 0.45;  ///< share of an overlap that one point yields
constexpr std::size_t kRounds = 160, kRoundsAtMost = 800;
constexpr std::size_t kWork = 800'000;  ///< points x rounds that may be spent when there are few points
constexpr double kStrideAtMost = 0.3;   ///< of the target, in one round

/// For each point the distance of its nearest neighbour, as a multiple of its reach.
std::vector<double> gaps(const Points& points, const std::vector<double>& reach) {
    Vec3 low = points.front(), high = low;
    for (const Vec3& p : points) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const double n = static_cast<double>(points.size());
    const Vec3 size = high - low;
    const double side = std::max({std::cbrt(size.x * size.y * size.z / n), std::sqrt(size.x * size.y / n),
                                  std::sqrt(size.y * size.z / n), std::sqrt(size.x * size.z / n),
                                  std::max({size.x, size.y, size.z}) / n});
    if (side <= 0.0) return std::vector<double>(points.size(), 0.0);
    const SpaceGrid grid(points, side);
    std::vector<double> out;
    for (std::size_t i = 0; i < points.size(); ++i) {
        double squared = kInfinite;
        for (std::ptrdiff_t rings = 1;; rings *= 2) {
            grid.near(points[i], rings, [&](std::size_t j, const Vec3& q) {
                if (j != i) squared = std::min(squared, glm::dot(q - points[i], q - points[i]));
            });
            const double seen = static_cast<double>(rings) * grid.side();
            if (squared <= seen * seen || seen > glm::length(size)) break;
        }
        out.push_back(std::sqrt(squared) / reach[i]);
    }
    return out;
}

/// How far point i gives way so that `target` lies between it and another that is `apart` from it.
Vec3 yielded(const Freedom& freedom, const Vec3& apart, double target, std::size_t i) {
    Vec3 way = freedom.of(apart);
    double length = glm::length(way);
    const double across = glm::dot(apart, apart) - length * length;  // squared, what no movement of its own changes
    if (across >= target * target) return {};
    if (length < 1e-6 * target) {  // face to face: to any side
        Random random(i);
        way = freedom.of({random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-1.0, 1.0)});
        length = glm::length(way);
        if (length <= 0.0) return {};
        return way / length * (0.2 * target);
    }
    return way * ((std::sqrt(target * target - std::max(across, 0.0)) - length) / length);
}

}  // namespace

double smallest_share(const Points& points, const std::vector<double>& reach) {
    if (points.size() < 2) return kInfinite;
    const std::vector<double> all = gaps(points, reach);
    return *std::min_element(all.begin(), all.end());
}

std::size_t spread_rounds(std::size_t count) {
    return std::clamp(kWork / count, kRounds, kRoundsAtMost);
}

Targets targets_for(const Points& points, const std::vector<double>& reach) {
    if (points.size() < 2) return {};
    std::vector<double> sorted = gaps(points, reach);
    std::sort(sorted.begin(), sorted.end());
    const double wide = sorted[sorted.size() * 3 / 4];
    return {kFirst * wide, kLast * wide};
}

void spread_apart(Points& points, const std::vector<double>& reach, const Ground& ground, const Targets& targets,
                  std::size_t rounds, const Run& run) {
    double best_share = smallest_share(points, reach);
    if (points.size() < 2 || !(targets.last > 0.0)) return;
    Points best = points, push(points.size());
    for (std::size_t round = 0; round <= rounds && !run.stopped(); ++round) {
        const double done = static_cast<double>(round) / static_cast<double>(rounds);
        const double target = targets.first + (targets.last - targets.first) * done;
        if (target < best_share) break;  // nothing to win any more
        const SpaceGrid grid(points, target);
        double smallest = target;
        std::fill(push.begin(), push.end(), Vec3{});
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double own = target * reach[i];
            const Freedom freedom = ground.freedom(i);
            grid.near(points[i], static_cast<std::ptrdiff_t>(std::ceil(own / grid.side())),
                      [&](std::size_t j, const Vec3& q) {
                          if (reach[j] < reach[i] || (reach[j] == reach[i] && j <= i)) return;
                          const Vec3 apart = points[i] - q;
                          const double squared = glm::dot(apart, apart);
                          if (squared >= own * own) return;
                          smallest = std::min(smallest, std::sqrt(squared) / reach[i]);
                          const Freedom other = ground.freedom(j);
                          const bool both = freedom.kind != Freedom::Kind::none && other.kind != Freedom::Kind::none;
                          const double step = both ? kStep : 2.0 * kStep;
                          push[i] += step * yielded(freedom, apart, own, i);
                          push[j] += step * yielded(other, -apart, own, j);
                      });
        }
        if (smallest > best_share) {
            best_share = smallest;
            best = points;
        }
        if (round == rounds) break;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double length = glm::length(push[i]), most = kStrideAtMost * target * reach[i];
            if (length <= 0.0) continue;
            points[i] = ground.move(i, points[i] + (length > most ? push[i] * (most / length) : push[i]));
        }
    }
    points = std::move(best);
}

}  // namespace aerogram::planner
