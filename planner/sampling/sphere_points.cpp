#include "planner/sampling/sphere_points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "geo/units.hpp"
#include "planner/sampling/closest_pair.hpp"

namespace aerogram::planner {
namespace {

constexpr std::size_t kRoundsAtMost = 400;
constexpr std::size_t kWork = 600'000;  ///< points x rounds, above which there are fewer rounds
constexpr std::size_t kRoundsAtLeast = 60;
constexpr std::size_t kRoundsPerNeighbourSearch = 10;
constexpr std::size_t kCheckedEachRound = 256;  ///< above it the smallest spacing is looked at in fewer rounds

/// The golden-angle spiral: nearly even, but for about four fifths of the best smallest spacing.
Points spiral(std::size_t count) {
    const double golden_angle = kPi * (3.0 - std::sqrt(5.0));
    Points points;
    points.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double z = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(count);
        const double ring = std::sqrt(std::max(0.0, 1.0 - z * z)), angle = golden_angle * static_cast<double>(i);
        points.emplace_back(ring * std::cos(angle), ring * std::sin(angle), z);
    }
    return points;
}

double ellipsoid_area(const Vec3& r) {
    constexpr double p = 1.6075;  // Thomsen's approximation, 1 %: only sets the reach of the repulsion
    const double mean = (std::pow(r.x * r.y, p) + std::pow(r.x * r.z, p) + std::pow(r.y * r.z, p)) / 3.0;
    return 4.0 * kPi * std::pow(mean, 1.0 / p);
}

double raised(double base, int power) {
    double result = 1.0;
    for (; power > 0; power /= 2, base *= base) {
        if (power % 2 == 1) result *= base;
    }
    return result;
}

/// For each point those within `reach`, in ascending order.
std::vector<std::vector<std::size_t>> neighbours_within(const Points& points, double reach) {
    std::vector<std::size_t> by_height(points.size());
    for (std::size_t i = 0; i < by_height.size(); ++i) by_height[i] = i;
    std::vector<std::vector<std::size_t>> near(points.size());
    std::sort(by_height.begin(), by_height.end(), [&](std::size_t a, std::size_t b) {
        return points[a].z != points[b].z ? points[a].z < points[b].z : a < b;
    });
    for (std::size_t k = 0; k < by_height.size(); ++k) {
        const std::size_t i = by_height[k];
        for (std::size_t m = k + 1; m < by_height.size(); ++m) {
            const std::size_t j = by_height[m];
            if (points[j].z - points[i].z > reach) break;
            if (glm::distance(points[i], points[j]) > reach) continue;
            near[i].push_back(j);
            near[j].push_back(i);
        }
    }
    for (auto& list : near) std::sort(list.begin(), list.end());
    return near;
}

}  // namespace

Points spread_on_ellipsoid(const Vec3& radii, std::size_t count, const Run& run) {
    Points points = spiral(count);
    for (Vec3& p : points) p *= radii;
    if (count < 2) return points;
    // Side of the triangular lattice with this many points on this area: no spread can have a wider smallest spacing.
    const double ideal = std::sqrt(ellipsoid_area(radii) / static_cast<double>(count) * 2.0 / std::numbers::sqrt3);
    const double reach = count <= 64 ? 4.0 * glm::length(radii) : 2.2 * ideal;
    const std::size_t rounds = std::clamp(kWork / count, kRoundsAtLeast, kRoundsAtMost);

    Points best = points, push(count);
    double best_spacing = closest_pair(points, {}).distance_m;
    std::vector<std::vector<std::size_t>> near;
    for (std::size_t round = 0; round < rounds && !run.stopped(); ++round) {
        const double progress = static_cast<double>(round) / static_cast<double>(rounds);
        const int power = 2 + static_cast<int>(12.0 * progress);  // of the square: ever more the nearest alone decides
        const double step = 0.2 * ideal * std::pow(0.01, progress);
        if (round % kRoundsPerNeighbourSearch == 0) near = neighbours_within(points, reach);
        double strongest = 0.0;
        for (std::size_t i = 0; i < count; ++i) {
            Vec3 force{};
            for (const std::size_t j : near[i]) {
                const Vec3 away = points[i] - points[j];
                const double inverse = ideal * ideal / std::max(glm::dot(away, away), 1e-12 * ideal * ideal);
                force += away * (std::sqrt(inverse) * raised(inverse, power));
            }
            const Vec3 normal = glm::normalize(points[i] / (radii * radii));
            push[i] = force - glm::dot(force, normal) * normal;
            strongest = std::max(strongest, glm::length(push[i]));
        }
        if (strongest <= 0.0) break;
        for (std::size_t i = 0; i < count; ++i) {
            const Vec3 moved = points[i] + push[i] * (step / strongest);
            points[i] = glm::normalize(moved / radii) * radii;
        }
        const bool last = round + 1 == rounds;
        if (count > kCheckedEachRound && round % kRoundsPerNeighbourSearch != 0 && !last) continue;
        const double spacing = closest_pair(points, {}).distance_m;
        if (spacing > best_spacing) {
            best_spacing = spacing;
            best = points;
        }
    }
    return best;
}

}  // namespace aerogram::planner
