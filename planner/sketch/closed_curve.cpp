#include "planner/sketch/closed_curve.hpp"

#include <cmath>
#include <utility>

#include "geo/contract.hpp"

namespace aerogram::planner {
namespace {

constexpr double kEntriesPerEdge = 4.0;  ///< of the row table, on average

/// Whether two segments cross at a point inside both.
bool cross(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
    return turn_of(a, b, c) * turn_of(a, b, d) < 0.0 && turn_of(c, d, a) * turn_of(c, d, b) < 0.0;
}

}  // namespace

ClosedCurve::ClosedCurve(Contour corners) : corners_(std::move(corners)) {
    AEROGRAM_REQUIRE(!corners_.empty());
    bounds_ = bounds_of(Region{{corners_}});
    const double height = bounds_.size().y;
    double climbs = 0.0;
    for (std::size_t k = 0; k < corners_.size(); ++k) climbs += std::abs(to(k).y - from(k).y);
    const auto edges = static_cast<double>(corners_.size());
    const double rows = climbs > 0.0 ? std::clamp(kEntriesPerEdge * edges * height / climbs, 1.0, edges) : 1.0;
    last_row_ = std::floor(rows) - 1.0;
    row_height_ = height > 0.0 ? height / (last_row_ + 1.0) : 1.0;
    starts_.assign(static_cast<std::size_t>(last_row_) + 2, 0);
    const auto over_rows = [&](std::size_t k, const auto& put) {
        const std::size_t last = row(std::max(from(k).y, to(k).y));
        for (std::size_t r = row(std::min(from(k).y, to(k).y)); r <= last; ++r) put(r);
    };
    for (std::size_t k = 0; k < corners_.size(); ++k) over_rows(k, [&](std::size_t r) { ++starts_[r + 1]; });
    for (std::size_t r = 1; r < starts_.size(); ++r) starts_[r] += starts_[r - 1];
    edges_.resize(starts_.back());
    std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
    for (std::size_t k = 0; k < corners_.size(); ++k) over_rows(k, [&](std::size_t r) { edges_[next[r]++] = k; });
}

double ClosedCurve::area() const {
    double doubled = 0.0;
    for (std::size_t k = 0; k < corners_.size(); ++k) doubled += turn_of(bounds_.low, from(k), to(k));
    return 0.5 * doubled;
}

bool ClosedCurve::contains(const Vec2& p) const {
    if (p.x < bounds_.low.x || p.y < bounds_.low.y || p.x > bounds_.high.x || p.y > bounds_.high.y) return false;
    int winding = 0;
    edges_between(p.y, p.y, [&](std::size_t k) {
        const Vec2 &a = from(k), &b = to(k);
        if ((a.y <= p.y) == (b.y <= p.y)) return;
        const bool up = a.y <= p.y;
        if (up == (turn_of(a, b, p) > 0.0)) winding += up ? 1 : -1;
    });
    return winding != 0;
}

bool ClosedCurve::holds(const ClosedCurve& other) const {
    const Bounds& box = other.bounds_;
    if (box.low.x < bounds_.low.x || box.low.y < bounds_.low.y || box.high.x > bounds_.high.x ||
        box.high.y > bounds_.high.y)
        return false;
    for (const Vec2& p : other.corners_) {
        if (!contains(p)) return false;
    }
    for (std::size_t k = 0; k < other.corners_.size(); ++k) {
        const Vec2 &a = other.from(k), &b = other.to(k);
        bool crosses = false;
        edges_between(std::min(a.y, b.y), std::max(a.y, b.y),
                      [&](std::size_t e) { crosses = crosses || cross(a, b, from(e), to(e)); });
        if (crosses) return false;
    }
    return true;
}

}  // namespace aerogram::planner
