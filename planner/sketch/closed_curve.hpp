#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

#include "geo/vec3.hpp"
#include "planner/sampling/region.hpp"

namespace aerogram::planner {

/// A closed curve as a polygon whose edges are found by rows, so that asking whether a point is inside costs a few
/// edges.
class ClosedCurve {
  public:
    /// @param corners  at least one finite point; the last joins the first.
    explicit ClosedCurve(Contour corners);

    [[nodiscard]] const Contour& corners() const { return corners_; }
    [[nodiscard]] const Bounds& bounds() const { return bounds_; }
    [[nodiscard]] double area() const;  ///< signed, counter-clockwise positive

    /// Whether the curve winds round p: the angle sum of paper 002, appendix A, counted by crossings of a ray.
    [[nodiscard]] bool contains(const Vec2& p) const;
    /// Whether all of the other curve is inside and no edges cross.
    [[nodiscard]] bool holds(const ClosedCurve& other) const;

    /// Calls visit(k) for edges k (corner k to the next) that may meet the heights [low, high], some more than once.
    template <class Visit>
    void edges_between(double low, double high, const Visit& visit) const {
        for (std::size_t r = row(low), last = row(high); r <= last; ++r) {
            for (std::size_t i = starts_[r]; i < starts_[r + 1]; ++i) visit(edges_[i]);
        }
    }
    [[nodiscard]] const Vec2& from(std::size_t edge) const { return corners_[edge]; }
    [[nodiscard]] const Vec2& to(std::size_t edge) const { return corners_[edge + 1 < corners_.size() ? edge + 1 : 0]; }

  private:
    [[nodiscard]] std::size_t row(double y) const {
        return static_cast<std::size_t>(std::clamp((y - bounds_.low.y) / row_height_, 0.0, last_row_));
    }

    Contour corners_;
    Bounds bounds_;
    double row_height_ = 1.0, last_row_ = 0.0;
    std::vector<std::size_t> starts_, edges_;  ///< edges by row
};

/// > 0 when c is to the left of the way from a to b.
[[nodiscard]] inline double turn_of(const Vec2& a, const Vec2& b, const Vec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

}  // namespace aerogram::planner
