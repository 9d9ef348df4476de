#include "planner/sampling/push_apart.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/sampling/site_grid.hpp"

namespace aerogram::planner {
namespace {

constexpr double kFirst = 0.97, kLast = 0.70;  ///< targets, shares of the ideal
constexpr double kRim = 1.5;    ///< few points stand mostly on the rim: this / sqrt(n) is added to kFirst
constexpr double kStep = 0.45;  ///< share of an overlap that one point yields

/// Stays where the area is: a move that would leave it goes along one axis, or not at all. Half covered cells and those
/// that are covered no less than where the point stands belong to it. A point outside (the middle of a cell of a bent
/// area may be) only moves in.
Vec2 kept_within(const DensityRaster& within, const Vec2& from, const Vec2& to) {
    const float least = std::min(0.5F, within.at(from));
    for (const Vec2& p : {to, Vec2(to.x, from.y), Vec2(from.x, to.y)}) {
        const float there = within.at(p);
        if (there >= least && there > 0.0F) return p;
    }
    return from;
}

}  // namespace

double smallest_distance(const std::vector<Vec2>& points) {
    if (points.size() < 2) return std::numeric_limits<double>::infinity();
    Vec2 low = points.front(), high = low;
    for (const Vec2& p : points) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const Vec2 size = high - low;
    const double n = static_cast<double>(points.size());
    // At most this far apart are the two nearest: n discs of that diameter fill no more than the box around them.
    const double bound = std::max(2.0 * std::sqrt(size.x * size.y / n), 2.0 * std::max(size.x, size.y) / n);
    if (bound <= 0.0) return 0.0;
    double smallest = std::numeric_limits<double>::infinity();
    const SiteGrid grid(points, bound);
    for (std::size_t i = 0; i < points.size(); ++i) {
        grid.near(points[i], 1, [&](std::size_t j, const Vec2& q) {
            if (j > i) smallest = std::min(smallest, glm::distance(points[i], q));
        });
    }
    return smallest;
}

void push_apart(std::vector<Vec2>& points, std::size_t fixed, const DensityRaster& within, double ideal,
                std::size_t rounds, const Run& run) {
    if (points.size() < 2 || fixed >= points.size()) return;
    std::vector<Vec2> best = points, push(points.size());
    double best_distance = smallest_distance(points);
    const double first = kFirst + kRim / std::sqrt(static_cast<double>(points.size()));
    for (std::size_t round = 0; round < rounds && !run.stopped(); ++round) {
        const double share = static_cast<double>(round) / static_cast<double>(rounds);
        const double target = ideal * (first + (kLast - first) * share);
        if (target < best_distance) break;  // nothing to win any more
        const SiteGrid grid(points, target);
        double smallest = std::numeric_limits<double>::infinity();
        std::fill(push.begin(), push.end(), Vec2{});
        for (std::size_t i = 0; i < points.size(); ++i) {
            grid.near(points[i], 1, [&](std::size_t j, const Vec2& q) {
                if (j <= i) return;
                Vec2 apart = points[i] - q;
                const double squared = glm::dot(apart, apart);
                if (squared >= target * target) return;
                const double distance = std::sqrt(squared);
                smallest = std::min(smallest, distance);
                if (distance < 1e-9 * target) {
                    apart = Vec2(1e-6 * target * static_cast<double>(i + 1), 1e-6 * target);
                } else {
                    apart *= (target - distance) / distance;
                }
                const bool both = i >= fixed && j >= fixed;
                const double step = both ? kStep : 2.0 * kStep;
                if (i >= fixed) push[i] += step * apart;
                if (j >= fixed) push[j] -= step * apart;
            });
        }
        if (std::min(smallest, target) > best_distance) {
            best_distance = std::min(smallest, target);
            best = points;
        }
        for (std::size_t i = fixed; i < points.size(); ++i) {
            const double length = glm::length(push[i]);
            if (length > 0.3 * target) push[i] *= 0.3 * target / length;
            points[i] = kept_within(within, points[i], points[i] + push[i]);
        }
    }
    if (smallest_distance(points) <= best_distance) points = std::move(best);
}

}  // namespace aerogram::planner
