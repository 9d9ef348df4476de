#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "geo/vec3.hpp"

namespace aerogram::planner {

/// Points of the plane or of space by square buckets, so that those near a place are found at once.
template <class Vec>
class BasicSiteGrid {
  public:
    /// @param side  of a bucket, > 0; made wider where there would be more than a few buckets a site.
    BasicSiteGrid(const std::vector<Vec>& sites, double side) : side_(side) {
        low_ = high_ = sites.empty() ? Vec{} : sites.front();
        for (const Vec& p : sites) {
            low_ = glm::min(low_, p);
            high_ = glm::max(high_, p);
        }
        const double buckets_at_most = 64.0 * static_cast<double>(sites.size()) + 64.0;
        while (buckets_across() > buckets_at_most) side_ *= kPlane ? 2.0 : 1.25;
        std::size_t buckets = 1;
        for (int axis = 0; axis < Vec::length(); ++axis) {
            across_[axis] = static_cast<std::ptrdiff_t>((high_[axis] - low_[axis]) / side_) + 1;
            buckets *= static_cast<std::size_t>(across_[axis]);
        }
        starts_.assign(buckets + 1, 0);
        for (const Vec& p : sites) ++starts_[bucket_of(p) + 1];
        for (std::size_t b = 1; b < starts_.size(); ++b) starts_[b] += starts_[b - 1];
        std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
        index_.resize(sites.size());
        at_.resize(sites.size());
        for (std::size_t i = 0; i < sites.size(); ++i) {
            const std::size_t place = next[bucket_of(sites[i])]++;
            index_[place] = i;
            at_[place] = sites[i];
        }
    }

    [[nodiscard]] double side() const { return side_; }

    /// Calls visit(index, position) for the sites in the buckets within `rings` of p's, lower index first in a bucket.
    template <class Visit>
    void near(const Vec& p, std::ptrdiff_t rings, const Visit& visit) const {
        const Range x = range(p, 0, rings), y = range(p, 1, rings), z = range(p, kPlane ? 1 : 2, kPlane ? 0 : rings);
        for (std::ptrdiff_t level = kPlane ? 0 : z.first; level <= (kPlane ? 0 : z.last); ++level) {
            for (std::ptrdiff_t row = y.first; row <= y.last; ++row) {
                const auto line = static_cast<std::size_t>((level * across_[1] + row) * across_[0]);
                const std::size_t end = starts_[line + static_cast<std::size_t>(x.last) + 1];
                for (std::size_t k = starts_[line + static_cast<std::size_t>(x.first)]; k < end; ++k) {
                    visit(index_[k], at_[k]);
                }
            }
        }
    }

    /// The nearest site; of equally near ones the lowest index. There must be one.
    [[nodiscard]] std::size_t nearest(const Vec& p) const {
        std::size_t best = 0;
        double squared = 1e300;
        std::ptrdiff_t widest = across_[0];
        for (int axis = 1; axis < Vec::length(); ++axis) widest += across_[axis];
        for (std::ptrdiff_t rings = 1;; rings *= 2) {
            near(p, rings, [&](std::size_t i, const Vec& site) {
                const Vec d = site - p;
                const double now = glm::dot(d, d);
                if (now > squared || (now == squared && i > best)) return;
                best = i;
                squared = now;
            });
            const double reach = static_cast<double>(rings) * side_;
            if (squared <= reach * reach || rings > widest) return best;
        }
    }

  private:
    static constexpr bool kPlane = Vec::length() == 2;
    struct Range {
        std::ptrdiff_t first, last;
    };

    [[nodiscard]] double buckets_across() const {
        double product = 1.0;
        for (int axis = 0; axis < Vec::length(); ++axis) product *= (high_[axis] - low_[axis]) / side_ + 1.0;
        return product;
    }
    [[nodiscard]] std::ptrdiff_t place(double at, int axis) const {
        const double last = static_cast<double>(across_[axis] - 1);
        return static_cast<std::ptrdiff_t>(std::clamp((at - low_[axis]) / side_, 0.0, last));
    }
    [[nodiscard]] Range range(const Vec& p, int axis, std::ptrdiff_t rings) const {
        const std::ptrdiff_t own = place(p[axis], axis);
        return {std::max<std::ptrdiff_t>(own - rings, 0), std::min(own + rings, across_[axis] - 1)};
    }
    [[nodiscard]] std::size_t bucket_of(const Vec& p) const {
        std::ptrdiff_t bucket = 0;
        for (int axis = Vec::length() - 1; axis >= 0; --axis) bucket = bucket * across_[axis] + place(p[axis], axis);
        return static_cast<std::size_t>(bucket);
    }

    double side_;
    Vec low_{}, high_{};
    std::ptrdiff_t across_[3] = {1, 1, 1};
    std::vector<std::size_t> starts_, index_;
    std::vector<Vec> at_;
};

using SiteGrid = BasicSiteGrid<Vec2>;
using SpaceGrid = BasicSiteGrid<Vec3>;

}  // namespace aerogram::planner
