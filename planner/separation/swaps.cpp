#include "planner/separation/swaps.hpp"

#include <algorithm>
#include <numeric>

#include "geo/contract.hpp"

namespace aerogram::planner {
namespace {

constexpr double kLeastGain_m2 = 1e-9;   ///< products nearer to zero than this are rounding
constexpr std::size_t kLargest = 3'000;  ///< drones of a cluster that are compared all with all

std::uint32_t root(std::vector<std::uint32_t>& parent, std::uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
}

/// The drones that hang together by stuck pairs, each cluster in ascending order.
std::vector<std::vector<std::uint32_t>> clusters(std::size_t drones,
                                                 std::span<const std::pair<std::uint32_t, std::uint32_t>> stuck) {
    std::vector<std::uint32_t> parent(drones);
    std::iota(parent.begin(), parent.end(), 0U);
    for (const auto& [i, j] : stuck) {
        const std::uint32_t a = root(parent, i), b = root(parent, j);
        parent[std::max(a, b)] = std::min(a, b);
    }
    std::vector<std::vector<std::uint32_t>> members(drones), result;
    for (std::uint32_t i = 0; i < drones; ++i) members[root(parent, i)].push_back(i);
    for (auto& cluster : members) {
        if (cluster.size() > 1) result.push_back(std::move(cluster));
    }
    return result;
}

}  // namespace

std::size_t swap_stuck(std::span<const Vec3> from_m, std::span<const Vec3> to_m,
                       std::span<const std::pair<std::uint32_t, std::uint32_t>> stuck, const SeparationMetric& metric,
                       std::vector<std::uint32_t>& target_of) {
    AEROGRAM_REQUIRE(from_m.size() == to_m.size() && target_of.size() == to_m.size(), from_m.size(), to_m.size());
    std::size_t swaps = 0;
    const auto uncross = [&](std::uint32_t i, std::uint32_t j) {
        const Vec3 a = metric.scaled(from_m[i] - from_m[j]);
        const Vec3 b = metric.scaled(to_m[target_of[i]] - to_m[target_of[j]]);
        if (glm::dot(a, b) >= -kLeastGain_m2) return false;
        std::swap(target_of[i], target_of[j]);
        ++swaps;
        return true;
    };
    for (const auto& cluster : clusters(from_m.size(), stuck)) {
        if (cluster.size() > kLargest) continue;
        for (bool changed = true; changed;) {
            changed = false;
            for (std::size_t p = 0; p < cluster.size(); ++p) {
                for (std::size_t q = p + 1; q < cluster.size(); ++q) {
                    changed = uncross(cluster[p], cluster[q]) || changed;
                }
            }
        }
    }
    for (bool changed = true; changed;) {  // larger clusters: the stuck pairs themselves
        changed = false;
        for (const auto& [i, j] : stuck) changed = uncross(i, j) || changed;
    }
    return swaps;
}

}  // namespace aerogram::planner
