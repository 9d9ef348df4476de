#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

#include "geo/vec3.hpp"

namespace aerogram::planner {

/// Points of the plane by square buckets, so that those near a place are found at once.
class SiteGrid {
  public:
    /// @param side  of a bucket, > 0; made wider where there would be more than a few buckets a site.
    SiteGrid(const std::vector<Vec2>& sites, double side) : side_(side) {
        low_ = high_ = sites.empty() ? Vec2{} : sites.front();
        for (const Vec2& p : sites) {
            low_ = glm::min(low_, p);
            high_ = glm::max(high_, p);
        }
        const double buckets_at_most = 64.0 * static_cast<double>(sites.size()) + 64.0;
        while ((high_.x - low_.x + side_) * (high_.y - low_.y + side_) > buckets_at_most * side_ * side_) side_ *= 2.0;
        across_ = static_cast<std::ptrdiff_t>((high_.x - low_.x) / side_) + 1;
        up_ = static_cast<std::ptrdiff_t>((high_.y - low_.y) / side_) + 1;
        starts_.assign(static_cast<std::size_t>(across_ * up_) + 1, 0);
        for (const Vec2& p : sites) ++starts_[bucket(column(p.x), row(p.y)) + 1];
        for (std::size_t b = 1; b < starts_.size(); ++b) starts_[b] += starts_[b - 1];
        std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
        index_.resize(sites.size());
        at_.resize(sites.size());
        for (std::size_t i = 0; i < sites.size(); ++i) {
            const std::size_t place = next[bucket(column(sites[i].x), row(sites[i].y))]++;
            index_[place] = i;
            at_[place] = sites[i];
        }
    }

    [[nodiscard]] double side() const { return side_; }

    /// Calls visit(index, position) for the sites in the buckets within `rings` of p's, lower index first in a bucket.
    template <class Visit>
    void near(const Vec2& p, std::ptrdiff_t rings, const Visit& visit) const {
        const std::ptrdiff_t c = column(p.x), r = row(p.y);
        const std::ptrdiff_t first = std::max<std::ptrdiff_t>(c - rings, 0), last = std::min(c + rings, across_ - 1);
        for (std::ptrdiff_t y = std::max<std::ptrdiff_t>(r - rings, 0); y <= std::min(r + rings, up_ - 1); ++y) {
            if (first > last) break;
            const std::size_t end = starts_[bucket(last, y) + 1];
            for (std::size_t k = starts_[bucket(first, y)]; k < end; ++k) visit(index_[k], at_[k]);
        }
    }

    /// The nearest site; of equally near ones the lowest index. There must be one.
    [[nodiscard]] std::size_t nearest(const Vec2& p) const {
        std::size_t best = 0;
        double squared = 1e300;
        for (std::ptrdiff_t rings = 1;; rings *= 2) {
            near(p, rings, [&](std::size_t i, const Vec2& site) {
                const Vec2 d = site - p;
                const double now = glm::dot(d, d);
                if (now > squared || (now == squared && i > best)) return;
                best = i;
                squared = now;
            });
            const double reach = static_cast<double>(rings) * side_;
            if (squared <= reach * reach || rings > across_ + up_) return best;
        }
    }

  private:
    [[nodiscard]] std::ptrdiff_t column(double x) const {
        return static_cast<std::ptrdiff_t>(std::clamp((x - low_.x) / side_, 0.0, static_cast<double>(across_ - 1)));
    }
    [[nodiscard]] std::ptrdiff_t row(double y) const {
        return static_cast<std::ptrdiff_t>(std::clamp((y - low_.y) / side_, 0.0, static_cast<double>(up_ - 1)));
    }
    [[nodiscard]] std::size_t bucket(std::ptrdiff_t c, std::ptrdiff_t r) const {
        return static_cast<std::size_t>(r * across_ + c);
    }

    double side_;
    Vec2 low_{}, high_{};
    std::ptrdiff_t across_ = 0, up_ = 0;
    std::vector<std::size_t> starts_, index_;
    std::vector<Vec2> at_;
};

}  // namespace aerogram::planner
