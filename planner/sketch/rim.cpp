#include "planner/sketch/rim.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "geo/units.hpp"
#include "planner/sketch/coordinate_tree.hpp"

namespace aerogram::planner {
namespace {

constexpr double kReach = 2.0 + 1e-6;         ///< median spacings
constexpr double kGap_rad = 2.0 * kPi / 3.0;  ///< 120 degrees
constexpr double kSlack_rad = 1e-6;           ///< a lattice's own angles are not above the limit by rounding
constexpr double kConeCosine = 0.5;           ///< of 60 degrees
constexpr std::size_t kDirections = 200;
constexpr std::size_t kNeighboursAtMost = 200;

std::vector<Vec3> directions() {
    std::vector<Vec3> out;
    for (std::size_t k = 0; k < kDirections; ++k) {  // Fibonacci's lattice on the sphere
        const double z = 1.0 - (2.0 * static_cast<double>(k) + 1.0) / static_cast<double>(kDirections);
        const double angle = kPi * (3.0 - std::sqrt(5.0)) * static_cast<double>(k), r = std::sqrt(1.0 - z * z);
        out.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
    }
    return out;
}

bool has_gap(std::vector<double>& angles) {
    if (angles.empty()) return true;
    std::sort(angles.begin(), angles.end());
    double widest = angles.front() + 2.0 * kPi - angles.back();
    for (std::size_t k = 1; k < angles.size(); ++k) widest = std::max(widest, angles[k] - angles[k - 1]);
    return widest > kGap_rad + kSlack_rad;
}

bool has_empty_cone(const std::vector<Vec3>& neighbours, const std::vector<Vec3>& all_directions) {
    const auto empty = [&](const Vec3& direction) {
        return std::all_of(neighbours.begin(), neighbours.end(),
                           [&](const Vec3& d) { return glm::dot(d, direction) < kConeCosine - kSlack_rad; });
    };
    Vec3 middle{};
    for (const Vec3& d : neighbours) middle += d;
    if (glm::length(middle) > 1e-6 && empty(-glm::normalize(middle))) return true;
    return std::any_of(all_directions.begin(), all_directions.end(), empty);
}

/// The median of the distances to the nearest other point.
double median_spacing(const std::vector<FormationCoordinate>& at, CoordinateTree& tree) {
    std::vector<double> spacings;
    for (std::uint32_t i = 0; i < at.size(); ++i) {
        const std::uint32_t except[] = {i};
        const FormationCoordinate& other = at[tree.nearest(at[i], except)];
        spacings.push_back(std::hypot(other[0] - at[i][0], other[1] - at[i][1], other[2] - at[i][2]));
    }
    const auto middle = spacings.begin() + static_cast<std::ptrdiff_t>(spacings.size() / 2);
    std::nth_element(spacings.begin(), middle, spacings.end());
    return *middle;
}

}  // namespace

std::vector<bool> rim_of(std::span<const Vec3> points_m) {
    if (points_m.size() < 3) return std::vector<bool>(points_m.size(), true);
    std::vector<FormationCoordinate> at;
    for (const Vec3& p : points_m) at.push_back({p.x, p.y, p.z, 0.0});
    CoordinateTree tree(at);
    const double reach = kReach * median_spacing(at, tree);
    DrawingPlane plane;
    const bool flat = is_flat(points_m, plane);
    const std::vector<Vec3> everywhere = flat ? std::vector<Vec3>{} : directions();
    std::vector<bool> rim;
    std::vector<double> angles;
    std::vector<Vec3> neighbours;
    for (std::size_t i = 0; i < points_m.size(); ++i) {
        angles.clear();
        neighbours.clear();
        tree.within(at[i], reach, [&](std::uint32_t j, double squared) {
            if (j == i || squared <= 0.0 || neighbours.size() >= kNeighboursAtMost) return;
            const Vec3 d = points_m[j] - points_m[i];
            const Vec2 seen(glm::dot(d, plane.right), glm::dot(d, plane.up));
            if (flat && glm::length(seen) > 0.0) angles.push_back(std::atan2(seen.y, seen.x));
            neighbours.push_back(glm::normalize(d));
        });
        rim.push_back(flat ? has_gap(angles) : has_empty_cone(neighbours, everywhere));
    }
    return rim;
}

}  // namespace aerogram::planner
