#include "planner/sketch/coordinate_tree.hpp"

#include <algorithm>
#include <numeric>

#include "geo/contract.hpp"

namespace aerogram::planner {

struct CoordinateTree::Search {
    const FormationCoordinate& to;
    std::span<const std::uint32_t> except;
    double squared = std::numeric_limits<double>::infinity();
    std::uint32_t best = kNobody;
};

CoordinateTree::CoordinateTree(std::span<const FormationCoordinate> points)
    : points_(points.begin(), points.end()), order_(points.size()), place_(points.size()), gone_(points.size(), false) {
    std::iota(order_.begin(), order_.end(), std::uint32_t{0});
    std::size_t nodes = 1;
    for (std::size_t widest = points.size(); widest > kLeaf; widest = widest - widest / 2) nodes = 2 * nodes + 1;
    cells_.resize(nodes);
    alive_.assign(nodes, 0);
    if (points_.empty()) return;
    build(0, 0, points_.size());
    std::vector<FormationCoordinate> sorted;
    sorted.reserve(points_.size());
    for (const std::uint32_t i : order_) sorted.push_back(points_[i]);
    points_ = std::move(sorted);
    for (std::size_t k = 0; k < order_.size(); ++k) place_[order_[k]] = static_cast<std::uint32_t>(k);
}

void CoordinateTree::build(std::size_t node, std::size_t begin, std::size_t end) {
    alive_[node] = static_cast<std::uint32_t>(end - begin);
    if (end - begin <= kLeaf) return;
    FormationCoordinate low = points_[order_[begin]], high = low;
    for (std::size_t k = begin; k < end; ++k) {
        for (std::size_t a = 0; a < low.size(); ++a) {
            low[a] = std::min(low[a], points_[order_[k]][a]);
            high[a] = std::max(high[a], points_[order_[k]][a]);
        }
    }
    std::size_t axis = 0;
    for (std::size_t a = 1; a < low.size(); ++a)
        if (high[a] - low[a] > high[axis] - low[axis]) axis = a;
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [&](std::size_t k) { return order_.begin() + static_cast<std::ptrdiff_t>(k); };
    std::nth_element(at(begin), at(middle), at(end), [&](std::uint32_t a, std::uint32_t b) {
        return points_[a][axis] != points_[b][axis] ? points_[a][axis] < points_[b][axis] : a < b;
    });
    cells_[node] = {axis, points_[order_[middle]][axis]};
    build(2 * node + 1, begin, middle);
    build(2 * node + 2, middle, end);
}

std::uint32_t CoordinateTree::nearest(const FormationCoordinate& to, std::span<const std::uint32_t> except) const {
    if (points_.empty()) return kNobody;
    Search s{to, except};
    search(0, 0, points_.size(), s);
    return s.best;
}

void CoordinateTree::search(std::size_t node, std::size_t begin, std::size_t end, Search& s) const {
    if (alive_[node] == 0) return;
    if (end - begin <= kLeaf) {
        for (std::size_t k = begin; k < end; ++k) {
            if (gone_[k]) continue;
            const double squared = squared_distance(points_[k], s.to);
            if (squared > s.squared || (squared == s.squared && order_[k] > s.best)) continue;
            if (std::binary_search(s.except.begin(), s.except.end(), order_[k])) continue;
            s.squared = squared;
            s.best = order_[k];
        }
        return;
    }
    const double side = s.to[cells_[node].axis] - cells_[node].split;
    const std::size_t middle = begin + (end - begin) / 2;
    const bool low_first = side < 0.0;
    for (const bool low : {low_first, !low_first}) {
        if (low != low_first && side * side > s.squared) return;
        search(2 * node + (low ? 1 : 2), low ? begin : middle, low ? middle : end, s);
    }
}

void CoordinateTree::remove(std::uint32_t index) {
    const std::size_t place = place_[index];
    AEROGRAM_REQUIRE(!gone_[place], index);
    gone_[place] = true;
    std::size_t node = 0, begin = 0, end = points_.size();
    for (--alive_[0]; end - begin > kLeaf; --alive_[node]) {
        const std::size_t middle = begin + (end - begin) / 2;
        const bool low = place < middle;
        node = 2 * node + (low ? 1 : 2);
        (low ? end : begin) = middle;
    }
}

}  // namespace aerogram::planner
