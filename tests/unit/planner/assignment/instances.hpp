#pragma once
#include <algorithm>
#include <numeric>

#include "planner/assignment/assignment.hpp"
#include "tests/unit/planner/adjacency/formations.hpp"

namespace aerogram::planner::testing {

inline const SeparationMetric kEuclidean{};

/// n places of an upright sheet, 2.2 m apart.
inline Points sheet(std::size_t n) {
    Points points = grid(static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(n)))), n, 2.2);
    points.resize(n);
    return points;
}
/// The same on the ground.
inline Points pads(std::size_t n) {
    Points points = sheet(n);
    for (Vec3& p : points) p = Vec3{p.x, p.z, 0.0};
    return points;
}
/// n places evenly along the strokes of T H E, about 2.2 m apart.
inline Points letters(std::size_t n) {
    const std::vector<std::pair<Vec2, Vec2>> lines{{{-8, 20}, {8, 20}},  {{0, 20}, {0, 0}},    {{14, 0}, {14, 20}},
                                                   {{26, 0}, {26, 20}},  {{14, 10}, {26, 10}}, {{32, 0}, {32, 20}},
                                                   {{32, 20}, {42, 20}}, {{32, 10}, {40, 10}}, {{32, 0}, {42, 0}}};
    double total = 0.0;
    for (const auto& [from, to] : lines) total += glm::length(to - from);
    Points points;
    for (std::size_t i = 0; i < n; ++i) {
        double left = (static_cast<double>(i) + 0.5) * total / static_cast<double>(n);
        for (const auto& [from, to] : lines) {
            const double length = glm::length(to - from);
            if (left <= length) {
                const Vec2 p = (from + (to - from) * (left / length)) * (2.2 * static_cast<double>(n) / total);
                points.emplace_back(p.x, 0.0, p.y + 10.0);
                break;
            }
            left -= length;
        }
    }
    return points;
}
/// About 2.2 m apart on a sphere.
inline Points ball(std::size_t n) {
    return sphere(n, 2.2 * std::sqrt(static_cast<double>(n) / 12.0));
}

inline double cost_of(const Points& from, const Points& to, const std::vector<SlotId>& slot_of,
                      const SeparationMetric& metric) {
    double cost = 0.0;
    for (std::size_t i = 0; i < from.size(); ++i) cost += std::pow(metric.distance(from[i], to[slot_of[i].value]), 2);
    return cost;
}

inline double brute_force_cost(const Points& from, const Points& to, const SeparationMetric& metric) {
    std::vector<SlotId> order;
    for (std::size_t i = 0; i < from.size(); ++i) order.emplace_back(i);
    double best = cost_of(from, to, order, metric);
    while (std::next_permutation(order.begin(), order.end())) best = std::min(best, cost_of(from, to, order, metric));
    return best;
}

inline bool is_bijection(std::vector<SlotId> slot_of) {
    std::sort(slot_of.begin(), slot_of.end());
    for (std::size_t i = 0; i < slot_of.size(); ++i)
        if (slot_of[i] != SlotId(i)) return false;
    return true;
}

inline std::vector<std::uint32_t> numbers(const std::vector<SlotId>& slot_of) {
    std::vector<std::uint32_t> values;
    for (const SlotId s : slot_of) values.push_back(s.value);
    return values;
}

inline Points shuffled(Points points, std::uint64_t seed) {
    Random random(seed);
    for (std::size_t i = points.size(); i-- > 1;) std::swap(points[i], points[random.bits() % (i + 1)]);
    return points;
}

}  // namespace aerogram::planner::testing
