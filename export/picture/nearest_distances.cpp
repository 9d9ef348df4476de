#include "export/picture/nearest_distances.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

namespace aerogram::exporter {
namespace {

constexpr std::size_t kLeaf = 8;  ///< points that are compared one by one

/// A balanced k-d tree over an order of the points: the middle of each range splits it along its longest side.
class Tree {
  public:
    explicit Tree(Points points) : points_(std::move(points)), order_(points_.size()), axis_(points_.size()) {
        std::iota(order_.begin(), order_.end(), std::size_t{0});
        split(0, order_.size());
    }

    [[nodiscard]] double nearest_squared(std::size_t point) const {
        double best = std::numeric_limits<double>::infinity();
        search(0, order_.size(), point, best);
        return best;
    }

  private:
    void split(std::size_t begin, std::size_t end) {
        if (end - begin <= kLeaf) return;
        Vec3 low = points_[order_[begin]], high = low;
        for (std::size_t i = begin; i < end; ++i) {
            low = glm::min(low, points_[order_[i]]);
            high = glm::max(high, points_[order_[i]]);
        }
        const Vec3 size = high - low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const std::size_t middle = begin + (end - begin) / 2;
        const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
        std::nth_element(at(begin), at(middle), at(end), [&](std::size_t a, std::size_t b) {
            return points_[a][axis] != points_[b][axis] ? points_[a][axis] < points_[b][axis] : a < b;
        });
        axis_[middle] = axis;
        split(begin, middle);
        split(middle + 1, end);
    }

    void compare(std::size_t place, std::size_t point, double& best) const {
        if (order_[place] == point) return;
        const Vec3 d = points_[order_[place]] - points_[point];
        best = std::min(best, glm::dot(d, d));
    }

    void search(std::size_t begin, std::size_t end, std::size_t point, double& best) const {
        if (end - begin <= kLeaf) {
            for (std::size_t i = begin; i < end; ++i) compare(i, point, best);
            return;
        }
        const std::size_t middle = begin + (end - begin) / 2;
        compare(middle, point, best);
        const double across = points_[point][axis_[middle]] - points_[order_[middle]][axis_[middle]];
        const bool below = across < 0.0;
        below ? search(begin, middle, point, best) : search(middle + 1, end, point, best);
        if (across * across > best) return;
        below ? search(middle + 1, end, point, best) : search(begin, middle, point, best);
    }

    Points points_;
    std::vector<std::size_t> order_;
    std::vector<int> axis_;  ///< by the place of a range's middle
};

}  // namespace

std::vector<double> nearest_distances(const Points& points_m, const SeparationMetric& metric) {
    if (points_m.size() < 2) return {};
    Points scaled;
    scaled.reserve(points_m.size());
    for (const Vec3& p : points_m) scaled.push_back(metric.scaled(p));
    const Tree tree(std::move(scaled));
    std::vector<double> out(points_m.size());
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = std::sqrt(tree.nearest_squared(i));
    return out;
}

}  // namespace aerogram::exporter
