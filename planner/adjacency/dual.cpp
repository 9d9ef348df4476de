#include "planner/adjacency/dual.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

// Legend: m midpoint of pq, h half its length. A centre m + t (t across pq) is nearer to p and q than to r exactly
// when 2 t·(r - m) <= |r - m|² - h².

namespace aerogram::planner {
namespace {

/// Keeps the part of a convex polygon where 2 t·u <= limit.
void clip(std::vector<Vec2>& polygon, const Vec2& u, double limit, std::vector<Vec2>& buffer) {
    buffer.clear();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2 here = polygon[i], next = polygon[(i + 1) % polygon.size()];
        const double slack_here = limit - 2.0 * glm::dot(here, u), slack_next = limit - 2.0 * glm::dot(next, u);
        if (slack_here >= 0.0) buffer.push_back(here);
        if ((slack_here < 0.0) != (slack_next < 0.0))
            buffer.push_back(here + (next - here) * (slack_here / (slack_here - slack_next)));
    }
    polygon.swap(buffer);
}

double width_of(const std::vector<Vec2>& polygon) {
    double twice_area = 0.0, perimeter = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2 a = polygon[i] - polygon[0], b = polygon[(i + 1) % polygon.size()] - polygon[0];
        twice_area += a.x * b.y - a.y * b.x;
        perimeter += glm::length(b - a);
    }
    return perimeter > 0.0 ? std::abs(twice_area) / perimeter : 0.0;
}

/// Unit vector across `along` from m to the nearest ring point off the pair's line: the square that stands for "within
/// reach" is turned by it, so that it moves with the points whatever their order.
Vec3 towards_nearest(const Vec3& m, const Vec3& along, std::span<const Vec3> ring_m) {
    Vec3 best = glm::cross(along, std::abs(along.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0});
    double nearest_m = std::numeric_limits<double>::infinity();
    for (const Vec3& r : ring_m) {
        const Vec3 d = r - m, across = d - along * glm::dot(d, along);
        if (glm::length(d) >= nearest_m || glm::length(across) < 1e-6 * glm::length(d)) continue;
        nearest_m = glm::length(d);
        best = across;
    }
    return glm::normalize(best);
}

}  // namespace

double dual_length_m(const Vec2& p_m, const Vec2& q_m, std::span<const Vec2> ring_m, double reach_m) {
    const Vec2 m = (p_m + q_m) / 2.0, along = glm::normalize(q_m - p_m), across{-along.y, along.x};
    const double h = glm::length(q_m - p_m) / 2.0;
    double low = -reach_m, high = reach_m;
    for (const Vec2& r : ring_m) {
        const Vec2 d = r - m;
        const double u = 2.0 * glm::dot(d, across), limit = glm::dot(d, d) - h * h;
        if (u > 0.0) high = std::min(high, limit / u);
        if (u < 0.0) low = std::max(low, limit / u);
        if (u == 0.0 && limit < 0.0) return 0.0;
    }
    return std::max(high - low, 0.0);
}

double dual_width_m(const Vec3& p_m, const Vec3& q_m, std::span<const Vec3> ring_m, double reach_m) {
    const Vec3 m = (p_m + q_m) / 2.0, along = glm::normalize(q_m - p_m);
    const double h = glm::length(q_m - p_m) / 2.0;
    const Vec3 right = towards_nearest(m, along, ring_m);
    const Vec3 up = glm::cross(along, right);
    std::vector<Vec2> polygon{{-reach_m, -reach_m}, {reach_m, -reach_m}, {reach_m, reach_m}, {-reach_m, reach_m}},
        buffer;
    for (const Vec3& r : ring_m) {
        const Vec3 d = r - m;
        clip(polygon, {glm::dot(d, right), glm::dot(d, up)}, glm::dot(d, d) - h * h, buffer);
        if (polygon.size() < 3) return 0.0;
    }
    return width_of(polygon);
}

}  // namespace aerogram::planner
