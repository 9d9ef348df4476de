#include "planner/text/baseline.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "planner/sampling/bezier_line.hpp"

namespace aerogram::planner {
namespace {

constexpr double kChordShare = 1e-7;  ///< how far chords may stray from their curve, of the line's box

/// The width or height of the points' box, whichever is more; not finite where a point is not.
double reach_of(const std::vector<Vec2>& points) {
    double reach = 0.0;
    for (const Vec2& p : points) {
        const Vec2 d = glm::abs(p - points.front());
        if (!std::isfinite(d.x) || !std::isfinite(d.y)) return d.x + d.y;
        reach = std::max({reach, d.x, d.y});
    }
    return reach;
}

}  // namespace

Result<Baseline> Baseline::of(const DrawnLine& line, double width) {
    const double reach = reach_of(line.points);
    if (!(reach > 1e-100) || !std::isfinite(reach)) {
        return Error{ErrorCode::invalid_input, "along: the line has no length"};
    }
    Baseline out;
    out.closed_ = line.closed;
    std::vector<Vec2> points = line.bezier ? flattened(line.points, line.closed, kChordShare * reach) : line.points;
    if (line.closed) points.push_back(points.front());
    double length = 0.0;
    for (const Vec2& p : points) {
        const double step = out.points_.empty() ? 0.0 : glm::length(p - out.points_.back());
        if (!out.points_.empty() && step <= 1e-12 * reach) continue;
        length += step;
        out.points_.push_back(p);
        out.along_.push_back(length);
    }
    for (Vec2& p : out.points_) p *= width / length;
    for (double& s : out.along_) s *= width / length;
    return out;
}

LetterFrame Baseline::at(double middle) const {
    const double length = along_.back();
    if (closed_) middle -= length * std::floor(middle / length);
    const auto after = std::upper_bound(along_.begin() + 1, along_.end() - 1, middle);
    const auto i = static_cast<std::size_t>(after - along_.begin());
    const Vec2 piece = points_[i] - points_[i - 1];
    LetterFrame frame;
    frame.right = piece / glm::length(piece);
    frame.at = points_[i - 1] + (middle - along_[i - 1]) * frame.right;
    return frame;
}

}  // namespace aerogram::planner
