#include "planner/sampling/edge_placing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

namespace aerogram::planner {
namespace {

constexpr double kTooClose = 0.75;    ///< share of the gap
constexpr double kWorthwhile = 1.05;  ///< a wider change must better the spacing by this much
constexpr std::size_t kLookedAt = 3;  ///< points at each end: lines come close where they meet
constexpr double kReach = 5.0;        ///< gaps
constexpr std::array kShares{1.0, 1.25, 0.75, 1.5, 1.75, 2.0, 2.5, 3.0};  ///< of an equal gap, the mildest first

/// Where points stand along a path: the first `first` from its start, the last `last` from its end, equally in between.
struct Spread {
    double first = 0.0, last = 0.0;
};

class Path {
  public:
    explicit Path(const std::vector<Vec2>& points) : points_(points), along_{0.0} {
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
            along_.push_back(along_.back() + glm::distance(points[i], points[i + 1]));
        }
    }

    [[nodiscard]] double length() const { return along_.back(); }

    [[nodiscard]] Vec2 at(double distance) const {
        const auto after = std::upper_bound(along_.begin() + 1, along_.end() - 1, distance);
        const auto piece = static_cast<std::size_t>(after - along_.begin()) - 1;
        const double step = along_[piece + 1] - along_[piece];
        return points_[piece] + (points_[piece + 1] - points_[piece]) * ((distance - along_[piece]) / step);
    }

    [[nodiscard]] double inner_gap(const Spread& s, std::size_t count) const {
        return (length() - s.first - s.last) / static_cast<double>(count - 1);
    }

    [[nodiscard]] Vec2 point(const Spread& s, std::size_t i, std::size_t count) const {
        return at(count == 1 ? s.first : s.first + inner_gap(s, count) * static_cast<double>(i));
    }

  private:
    const std::vector<Vec2>& points_;
    std::vector<double> along_;  ///< length up to each point
};

/// The smallest spacing near the path's ends: along it, among its own points there, and to the others.
double spacing_of(const Path& path, const Spread& s, std::size_t count, const std::vector<Vec2>& others) {
    double smallest = std::min(s.first, s.last);
    if (count > 1) smallest = std::min(smallest, path.inner_gap(s, count));
    std::vector<Vec2> own;
    for (std::size_t i = 0; i < count; ++i) {
        if (i >= kLookedAt && i + kLookedAt < count) continue;
        const Vec2 p = path.point(s, i, count);
        for (const Vec2& o : own) smallest = std::min(smallest, glm::distance(p, o));
        for (const Vec2& o : others) smallest = std::min(smallest, glm::distance(p, o));
        own.push_back(p);
    }
    return smallest;
}

std::vector<Vec2> those_near(const std::vector<Vec2>& points, const Vec2& a, const Vec2& b, double reach) {
    std::vector<Vec2> near;
    std::copy_if(points.begin(), points.end(), std::back_inserter(near),
                 [&](const Vec2& p) { return glm::distance(p, a) <= reach || glm::distance(p, b) <= reach; });
    return near;
}

Spread best_spread(const Path& path, const std::vector<Vec2>& ends, std::size_t count,
                   const std::vector<Vec2>& others) {
    const double gap = path.length() / static_cast<double>(count + 1);
    Spread best{gap, gap};
    const std::vector<Vec2> near = those_near(others, ends.front(), ends.back(), kReach * gap);
    double best_spacing = spacing_of(path, best, count, near);
    if (best_spacing >= kTooClose * gap) return best;
    for (const double last : kShares) {
        for (const double first : kShares) {
            Spread s{first * gap, last * gap};
            if (count == 1) s.last = path.length() - s.first;
            if (s.last <= 0.0 || (count > 1 && path.inner_gap(s, count) <= 0.0)) continue;
            const double spacing = spacing_of(path, s, count, near);
            if (spacing <= best_spacing * kWorthwhile) continue;
            best_spacing = spacing;
            best = s;
        }
    }
    return best;
}

}  // namespace

std::vector<Vec2> points_along(const std::vector<Vec2>& path_points, std::size_t count,
                               const std::vector<Vec2>& others) {
    const Path path(path_points);
    const Spread spread = best_spread(path, path_points, count, others);
    std::vector<Vec2> out;
    for (std::size_t i = 0; i < count; ++i) out.push_back(path.point(spread, i, count));
    return out;
}

std::vector<std::size_t> points_inside(const std::vector<double>& lengths, std::size_t count) {
    struct Gap {
        double width;
        std::size_t edge;
        bool operator<(const Gap& other) const {
            return width != other.width ? width < other.width : edge > other.edge;
        }
    };
    std::priority_queue<Gap> gaps;
    for (std::size_t e = 0; e < lengths.size(); ++e) gaps.push({lengths[e] / 2.0, e});
    std::vector<std::size_t> inside(lengths.size(), 0);
    for (; count > 0; --count) {
        const std::size_t edge = gaps.top().edge;
        gaps.pop();
        ++inside[edge];
        gaps.push({lengths[edge] / static_cast<double>(inside[edge] + 2), edge});
    }
    return inside;
}

double length_of(const std::vector<Vec2>& path) {
    return Path(path).length();
}

}  // namespace aerogram::planner
