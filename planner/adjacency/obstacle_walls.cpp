#include "planner/adjacency/obstacle_walls.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <variant>

#include "geo/contract.hpp"

namespace aerogram::planner {
namespace {

/// As deep as this inside an obstacle is only touching it.
constexpr double kTouching_m = 1e-9;

double cross(const Vec2& a, const Vec2& b) {
    return a.x * b.y - a.y * b.x;
}

/// The share of the way that is between the obstacle's floor and its top.
std::optional<std::pair<double, double>> within_height(const geo::Obstacle& o, double from_m, double to_m) {
    const double low_m = o.base_m + kTouching_m, high_m = o.base_m + o.height_m - kTouching_m;
    double first = 0.0, last = 1.0;
    if (from_m == to_m) {
        if (from_m <= low_m || from_m >= high_m) return std::nullopt;
        return std::pair(first, last);
    }
    const double at_low = (low_m - from_m) / (to_m - from_m), at_high = (high_m - from_m) / (to_m - from_m);
    first = std::max(first, std::min(at_low, at_high));
    last = std::min(last, std::max(at_low, at_high));
    if (first >= last) return std::nullopt;
    return std::pair(first, last);
}

bool enters(const geo::Cylinder& cylinder, const Vec2& from, const Vec2& to) {
    const Vec2 along = to - from;
    const double length2 = glm::dot(along, along);
    const double t = length2 > 0.0 ? std::clamp(glm::dot(cylinder.center_m - from, along) / length2, 0.0, 1.0) : 0.0;
    return glm::length(from + t * along - cylinder.center_m) < cylinder.radius_m - kTouching_m;
}

/// Cut where it meets the outline's edges, a piece of the way is inside or outside as a whole.
bool enters(const geo::Prism& prism, const Vec2& from, const Vec2& to) {
    std::vector<double> cuts{0.0, 1.0};
    const Vec2 along = to - from;
    for (std::size_t i = 0; i < prism.outline_m.size(); ++i) {
        const Vec2& a = prism.outline_m[i];
        const Vec2 side = prism.outline_m[(i + 1) % prism.outline_m.size()] - a;
        const double turn = cross(along, side);
        if (turn == 0.0) continue;
        const double t = cross(a - from, side) / turn;
        if (t > 0.0 && t < 1.0) cuts.push_back(t);
    }
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t i = 1; i < cuts.size(); ++i) {
        const Vec2 middle = from + 0.5 * (cuts[i - 1] + cuts[i]) * along;
        if (geo::signed_distance(prism.outline_m, middle) > kTouching_m) return true;
    }
    return false;
}

/// A simple outline, turning left, without corners that are none.
geo::Polygon tidy(const geo::Polygon& outline_m) {
    double twice_area = 0.0, size_m = 0.0;
    for (std::size_t i = 0; i < outline_m.size(); ++i) {
        const Vec2 a = outline_m[i] - outline_m[0], b = outline_m[(i + 1) % outline_m.size()] - outline_m[0];
        twice_area += cross(a, b);
        size_m = std::max(size_m, glm::length(a));
    }
    geo::Polygon out;
    const std::size_t n = outline_m.size();
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2& before = out.empty() ? outline_m[n - 1] : out.back();
        const Vec2 in = outline_m[i] - before, on = outline_m[(i + 1) % n] - outline_m[i];
        if (std::abs(cross(in, on)) > 1e-9 * size_m * size_m) out.push_back(outline_m[i]);
    }
    if (twice_area < 0.0) std::reverse(out.begin(), out.end());
    return out;
}

bool in_triangle(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& p) {
    return cross(b - a, p - a) >= 0.0 && cross(c - b, p - b) >= 0.0 && cross(a - c, p - c) >= 0.0;
}

/// Triangles of an outline that turns left, by cutting off ears.
std::vector<std::array<std::uint32_t, 3>> ears_of(const geo::Polygon& outline) {
    std::vector<std::uint32_t> left(outline.size());
    for (std::uint32_t i = 0; i < left.size(); ++i) left[i] = i;
    std::vector<std::array<std::uint32_t, 3>> ears;
    while (left.size() > 3) {
        const std::size_t before = left.size();
        for (std::size_t i = 0; i < left.size(); ++i) {
            const std::uint32_t a = left[(i + left.size() - 1) % left.size()], b = left[i],
                                c = left[(i + 1) % left.size()];
            if (cross(outline[b] - outline[a], outline[c] - outline[b]) <= 0.0) continue;
            const bool free = std::none_of(left.begin(), left.end(), [&](std::uint32_t k) {
                return k != a && k != b && k != c && in_triangle(outline[a], outline[b], outline[c], outline[k]);
            });
            if (!free) continue;
            ears.push_back({a, b, c});
            left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
            break;
        }
        AEROGRAM_REQUIRE(left.size() < before, outline.size());  // every simple outline has an ear
    }
    ears.push_back({left[0], left[1], left[2]});
    return ears;
}

geo::Polygon outline_of(const geo::Obstacle& obstacle, std::size_t sides) {
    if (const auto* prism = std::get_if<geo::Prism>(&obstacle.shape)) return tidy(prism->outline_m);
    const auto& cylinder = std::get<geo::Cylinder>(obstacle.shape);
    const double step = 2.0 * std::numbers::pi / static_cast<double>(sides);
    const double radius_m = cylinder.radius_m / std::cos(0.5 * step);
    geo::Polygon outline;
    for (std::size_t i = 0; i < sides; ++i) {
        const double angle = step * static_cast<double>(i);
        outline.push_back(cylinder.center_m + radius_m * Vec2{std::cos(angle), std::sin(angle)});
    }
    return outline;
}

}  // namespace

bool passes_through(const geo::Obstacle& obstacle, const Vec3& from_m, const Vec3& to_m) {
    const auto shares = within_height(obstacle, from_m.z, to_m.z);
    if (!shares) return false;
    const Vec3 first = from_m + shares->first * (to_m - from_m), last = from_m + shares->second * (to_m - from_m);
    return std::visit(
        [&](const auto& shape) {
            return enters(shape, {first.x, first.y}, {last.x, last.y});
        },
        obstacle.shape);
}

TriangleMesh wall_of(const geo::Obstacle& obstacle, std::size_t sides) {
    AEROGRAM_REQUIRE(sides >= 3, sides);
    const geo::Polygon outline = outline_of(obstacle, sides);
    const auto n = static_cast<std::uint32_t>(outline.size());
    TriangleMesh wall;
    for (const double z_m : {obstacle.base_m, obstacle.base_m + obstacle.height_m})
        for (const Vec2& p : outline) wall.vertices.emplace_back(p.x, p.y, z_m);
    for (const auto& [a, b, c] : ears_of(outline)) {
        wall.triangles.push_back({a, c, b});
        wall.triangles.push_back({a + n, b + n, c + n});
    }
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t j = (i + 1) % n;
        wall.triangles.push_back({i, j, j + n});
        wall.triangles.push_back({i, j + n, i + n});
    }
    return wall;
}

}  // namespace aerogram::planner
