#include "planner/assignment/kd_order.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace aerogram::planner {
namespace {

void sort_kd(const Coordinates& points, std::vector<std::uint32_t>& order, std::size_t begin, std::size_t end,
             std::size_t leaf, const Vec3& weight) {
    if (end - begin <= leaf) return;
    const Box box = box_of(points, order, begin, end);
    const Vec3 size = weight * (box.high - box.low);
    const std::vector<double>& along = size.x >= size.y && size.x >= size.z ? points.x
                                       : size.y >= size.z                   ? points.y
                                                                            : points.z;
    const std::size_t middle = begin + (end - begin + leaf - 1) / leaf / 2 * leaf;
    const auto at = [&order](std::size_t k) { return order.begin() + static_cast<std::ptrdiff_t>(k); };
    std::nth_element(at(begin), at(middle), at(end),
                     [&](std::uint32_t a, std::uint32_t b) { return std::pair(along[a], a) < std::pair(along[b], b); });
    sort_kd(points, order, begin, middle, leaf, weight);
    sort_kd(points, order, middle, end, leaf, weight);
}

}  // namespace

Box box_of(const Coordinates& points, const std::vector<std::uint32_t>& order, std::size_t begin, std::size_t end) {
    Box box{points[order[begin]], points[order[begin]]};
    for (std::size_t k = begin + 1; k < end; ++k) {
        box.low = glm::min(box.low, points[order[k]]);
        box.high = glm::max(box.high, points[order[k]]);
    }
    return box;
}

std::vector<std::uint32_t> kd_order(const Coordinates& points, std::uint32_t leaf, const Vec3& weight) {
    std::vector<std::uint32_t> order(points.size());
    std::iota(order.begin(), order.end(), 0U);
    sort_kd(points, order, 0, order.size(), leaf, weight);
    return order;
}

Vec3 weights_by_spread(const Coordinates& others) {
    constexpr double kLeast = 1e-3;
    Vec3 sum{};
    for (std::size_t i = 0; i < others.size(); ++i) sum += others[i] * others[i];
    const double most = std::max({sum.x, sum.y, sum.z});
    if (!(most > 0.0)) return {1.0, 1.0, 1.0};
    return glm::max(Vec3{std::sqrt(sum.x / most), std::sqrt(sum.y / most), std::sqrt(sum.z / most)}, Vec3{kLeast});
}

}  // namespace aerogram::planner
