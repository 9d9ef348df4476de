#include "planner/sampling/thinning.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <queue>
#include <tuple>

#include "geo/contract.hpp"

namespace aerogram::planner {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

/// The two nearest of the points that are left, by squared distance and then by index.
struct Two {
    double first = kFar, second = kFar;
    std::size_t first_index = 0, second_index = 0;

    void offer(double squared, std::size_t index) {
        if (std::tie(squared, index) < std::tie(first, first_index)) {
            second = first;
            second_index = first_index;
            first = squared;
            first_index = index;
        } else if (std::tie(squared, index) < std::tie(second, second_index)) {
            second = squared;
            second_index = index;
        }
    }
};

/// A k-d tree whose points can be taken away: node by node the middle of its stretch of `order_`.
class Tree {
  public:
    explicit Tree(const Points& points) : points_(points), order_(points.size()), node_of_(points.size()) {
        std::iota(order_.begin(), order_.end(), std::size_t{0});
        left_.assign(points.size(), 0);
        axis_.assign(points.size(), 0);
        build(0, points.size());
    }

    [[nodiscard]] bool has(std::size_t point) const { return !gone(node_of_[point]); }

    void take_away(std::size_t point) {
        const std::size_t node = node_of_[point];
        std::size_t begin = 0, end = order_.size();
        for (;;) {
            const std::size_t middle = begin + (end - begin) / 2;
            --left_[middle];
            if (node == middle) break;
            (node < middle ? end : begin) = node < middle ? middle : middle + 1;
        }
        taken_.resize(order_.size(), false);
        taken_[node] = true;
    }

    [[nodiscard]] Two nearest(std::size_t point) const {
        Two two;
        search(0, order_.size(), point, two);
        return two;
    }

  private:
    [[nodiscard]] bool gone(std::size_t node) const { return !taken_.empty() && taken_[node]; }

    void build(std::size_t begin, std::size_t end) {
        if (begin >= end) return;
        Vec3 low(kFar), high(-kFar);
        for (std::size_t k = begin; k < end; ++k) {
            low = glm::min(low, points_[order_[k]]);
            high = glm::max(high, points_[order_[k]]);
        }
        const Vec3 size = high - low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const std::size_t middle = begin + (end - begin) / 2;
        const auto at = [&](std::size_t k) { return order_.begin() + static_cast<std::ptrdiff_t>(k); };
        std::nth_element(at(begin), at(middle), at(end), [&](std::size_t a, std::size_t b) {
            return points_[a][axis] != points_[b][axis] ? points_[a][axis] < points_[b][axis] : a < b;
        });
        axis_[middle] = axis;
        left_[middle] = end - begin;
        node_of_[order_[middle]] = middle;
        build(begin, middle);
        build(middle + 1, end);
    }

    void search(std::size_t begin, std::size_t end, std::size_t point, Two& two) const {
        if (begin >= end) return;
        const std::size_t middle = begin + (end - begin) / 2;
        if (left_[middle] == 0) return;
        const std::size_t here = order_[middle];
        if (here != point && !gone(middle)) {
            const Vec3 d = points_[here] - points_[point];
            two.offer(glm::dot(d, d), here);
        }
        const double across = points_[point][axis_[middle]] - points_[here][axis_[middle]];
        const bool lower = across < 0.0;
        search(lower ? begin : middle + 1, lower ? middle : end, point, two);
        if (across * across <= two.second) search(lower ? middle + 1 : begin, lower ? end : middle, point, two);
    }

    const Points& points_;
    std::vector<std::size_t> order_, node_of_;
    std::vector<std::size_t> left_;  ///< points left in a node's stretch
    std::vector<int> axis_;
    std::vector<bool> taken_;  ///< by node
};

struct Crowded {
    Two two;
    std::size_t point = 0;
    /// The most crowded comes first out of the queue.
    bool operator<(const Crowded& other) const {
        return std::tuple(two.first, two.second, other.point) > std::tuple(other.two.first, other.two.second, point);
    }
};

}  // namespace

std::vector<std::size_t> thinned(const Points& points, std::size_t count) {
    AEROGRAM_REQUIRE(count <= points.size(), count, points.size());
    Tree tree(points);
    std::priority_queue<Crowded> queue;
    for (std::size_t i = 0; i < points.size(); ++i) queue.push({tree.nearest(i), i});
    for (std::size_t left = points.size(); left > count;) {
        Crowded next = queue.top();
        queue.pop();
        const bool stale = (next.two.first < kFar && !tree.has(next.two.first_index)) ||
                           (next.two.second < kFar && !tree.has(next.two.second_index));
        if (stale) {  // neighbours only go, so the old distances were lower bounds
            next.two = tree.nearest(next.point);
            queue.push(next);
            continue;
        }
        tree.take_away(next.point);
        --left;
    }
    std::vector<std::size_t> out;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (tree.has(i)) out.push_back(i);
    }
    return out;
}

}  // namespace aerogram::planner
