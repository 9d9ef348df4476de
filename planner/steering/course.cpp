#include "planner/steering/course.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <queue>

namespace aerogram::planner {
namespace {

constexpr double kMostCells = 200'000.0;
constexpr double kCellShare = 1.0 / 40.0;   ///< of the way's length
constexpr double kPriceOfIntrusion = 20.0;  ///< times the way, for a body that is in the way with all of its radius

/// Distance to an obstacle seen from above, metres; negative over it.
double from_above(const geo::Obstacle& obstacle, const Vec3& p) {
    geo::Obstacle endless = obstacle;
    endless.base_m = -1e6;
    endless.height_m = 2e6;
    return geo::clearance(endless, p);
}

/// How far a body of this size reaches into what it should keep clear of.
double reach_in(const Vec3& middle, double radius_m, double half_m, const CourseSpace& space) {
    double worst = 0.0;
    for (const geo::Obstacle& obstacle : space.airspace.obstacles) {
        const double top_z = obstacle.base_m + obstacle.height_m;
        const double over = middle.z - half_m - space.keep_m - top_z;
        const double under = obstacle.base_m - space.keep_m - (middle.z + half_m);
        if (over >= 0.0 || under >= 0.0) continue;
        const double beside = radius_m + space.keep_m - from_above(obstacle, middle);
        worst = std::max(worst, std::min(beside, std::min(-over, -under)));
    }
    const Vec2 ground(middle.x, middle.y);
    for (const geo::Polygon& audience : space.airspace.audience_m)
        worst = std::max(worst, radius_m + space.keep_m + geo::signed_distance(audience, ground));
    if (!space.airspace.geofence_m.empty())
        worst = std::max(worst, radius_m + space.keep_m - geo::signed_distance(space.airspace.geofence_m, ground));
    worst = std::max({worst, space.floor_z_m + half_m - middle.z, middle.z + half_m - space.ceiling_z_m});
    return worst;
}

/// What a step at a place costs, a metre: 1 where the body is clear, more where it is not, infinite where not even its
/// middle may be.
double price(const Vec3& middle, const GroupBody& body, const CourseSpace& space) {
    if (reach_in(middle, 0.0, 0.0, space) > 0.0) return std::numeric_limits<double>::infinity();
    const double whole_m = std::max(body.radius_m, space.keep_m);
    return 1.0 + kPriceOfIntrusion * std::min(1.0, reach_in(middle, body.radius_m, body.half_m, space) / whole_m);
}

/// Mean price along a line times its length.
double price_of_line(const Vec3& a, const Vec3& b, double step_m, const GroupBody& body, const CourseSpace& space) {
    const auto steps = static_cast<int>(std::ceil(glm::distance(a, b) / step_m)) + 1;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) sum += price(a + (static_cast<double>(i) + 0.5) / steps * (b - a), body, space);
    return sum / steps * glm::distance(a, b);
}

/// Cells over everything that matters; cell (0, 0, 0) around `low`.
struct Grid {
    Vec3 low{};
    double side_m = 1.0;
    std::array<std::int64_t, 3> across{};

    [[nodiscard]] std::size_t index(const std::array<std::int64_t, 3>& c) const {
        return static_cast<std::size_t>((c[2] * across[1] + c[1]) * across[0] + c[0]);
    }
    [[nodiscard]] std::array<std::int64_t, 3> cell(std::size_t index) const {
        const auto i = static_cast<std::int64_t>(index);
        return {i % across[0], i / across[0] % across[1], i / (across[0] * across[1])};
    }
    [[nodiscard]] std::array<std::int64_t, 3> cell_of(const Vec3& p) const {
        std::array<std::int64_t, 3> out{};
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            out[a] = std::clamp<std::int64_t>(std::llround((p[axis] - low[axis]) / side_m), 0, across[a] - 1);
        }
        return out;
    }
    [[nodiscard]] Vec3 place(const std::array<std::int64_t, 3>& c) const {
        return low + side_m * Vec3(static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2]));
    }
    [[nodiscard]] bool holds(const std::array<std::int64_t, 3>& c) const {
        return c[0] >= 0 && c[1] >= 0 && c[2] >= 0 && c[0] < across[0] && c[1] < across[1] && c[2] < across[2];
    }
};

Grid grid_around(const Vec3& from, const Vec3& to, const GroupBody& body, const CourseSpace& space) {
    Vec3 low = glm::min(from, to), high = glm::max(from, to);
    for (const geo::Obstacle& obstacle : space.airspace.obstacles) {
        const auto* cylinder = std::get_if<geo::Cylinder>(&obstacle.shape);
        const geo::Polygon corners = cylinder ? geo::Polygon{cylinder->center_m - Vec2(cylinder->radius_m),
                                                             cylinder->center_m + Vec2(cylinder->radius_m)}
                                              : std::get<geo::Prism>(obstacle.shape).outline_m;
        for (const Vec2& corner : corners) {
            low = glm::min(low, Vec3(corner, low.z));
            high = glm::max(high, Vec3(corner, high.z));
        }
        high.z = std::max(high.z, obstacle.base_m + obstacle.height_m);
    }
    for (const geo::Polygon& audience : space.airspace.audience_m) {
        for (const Vec2& corner : audience) {
            low = glm::min(low, Vec3(corner, low.z));
            high = glm::max(high, Vec3(corner, high.z));
        }
    }
    const double around_m = body.radius_m + 3.0 * space.keep_m;
    low -= Vec3(around_m, around_m, 0.0);
    high += Vec3(around_m, around_m, body.half_m + 3.0 * space.keep_m);
    high.z = std::clamp(high.z, std::max(from.z, to.z), std::max({space.ceiling_z_m, from.z, to.z}));
    Grid grid{low, std::max(space.keep_m, kCellShare * glm::distance(from, to)), {}};
    const auto cells = [&] {
        double count = 1.0;
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            grid.across[a] = static_cast<std::int64_t>((high[axis] - low[axis]) / grid.side_m) + 2;
            count *= static_cast<double>(grid.across[a]);
        }
        return count;
    };
    while (cells() > kMostCells) grid.side_m *= 1.2;
    return grid;
}

/// The cheapest way over the grid's cells; empty where there is none.
std::vector<Vec3> cheapest(const Grid& grid, const Vec3& from, const Vec3& to, const GroupBody& body,
                           const CourseSpace& space) {
    struct Open {
        double estimate;
        std::size_t cell;
        bool operator>(const Open& other) const {
            return estimate != other.estimate ? estimate > other.estimate : cell > other.cell;
        }
    };
    const std::size_t start = grid.index(grid.cell_of(from)), goal = grid.index(grid.cell_of(to));
    const std::size_t count = grid.index({0, 0, grid.across[2]});
    std::vector<double> spent(count, std::numeric_limits<double>::infinity()), price_of(count, -1.0);
    std::vector<std::size_t> came_from(count, count);
    std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
    const auto priced = [&](std::size_t cell) {
        if (price_of[cell] < 0.0)
            price_of[cell] = cell == start || cell == goal ? 1.0 : price(grid.place(grid.cell(cell)), body, space);
        return price_of[cell];
    };
    spent[start] = 0.0;
    open.push({glm::distance(grid.place(grid.cell(start)), to), start});
    while (!open.empty()) {
        const Open now = open.top();
        open.pop();
        if (now.cell == goal) break;
        const auto at = grid.cell(now.cell);
        if (now.estimate > spent[now.cell] + glm::distance(grid.place(at), to) + 1e-9) continue;
        for (int step = 0; step < 27; ++step) {
            const std::array<std::int64_t, 3> next{at[0] + step % 3 - 1, at[1] + step / 3 % 3 - 1,
                                                   at[2] + step / 9 - 1};
            if (!grid.holds(next) || next == at) continue;
            const std::size_t cell = grid.index(next);
            const double length_m = glm::distance(grid.place(at), grid.place(next));
            const double cost = spent[now.cell] + 0.5 * (priced(now.cell) + priced(cell)) * length_m;
            if (!(cost < spent[cell])) continue;
            spent[cell] = cost;
            came_from[cell] = now.cell;
            open.push({cost + glm::distance(grid.place(next), to), cell});
        }
    }
    std::vector<Vec3> way;
    if (!std::isfinite(spent[goal])) return way;
    for (std::size_t cell = goal; cell != start; cell = came_from[cell]) way.push_back(grid.place(grid.cell(cell)));
    way.push_back(from);
    std::reverse(way.begin(), way.end());
    way.back() = to;
    return way;
}

/// Corners cut wherever the straight line is no dearer.
std::vector<Vec3> shortened(const std::vector<Vec3>& way, double step_m, const GroupBody& body,
                            const CourseSpace& space) {
    std::vector<double> paid{0.0};
    for (std::size_t i = 1; i < way.size(); ++i)
        paid.push_back(paid.back() + price_of_line(way[i - 1], way[i], step_m, body, space));
    std::vector<Vec3> out{way.front()};
    for (std::size_t i = 0; i + 1 < way.size();) {
        std::size_t next = i + 1;
        for (std::size_t j = way.size() - 1; j > next; --j) {
            if (price_of_line(way[i], way[j], step_m, body, space) <= paid[j] - paid[i] + 1e-9) next = j;
        }
        out.push_back(way[next]);
        i = next;
    }
    return out;
}

}  // namespace

double intrusion_m(const Vec3& middle, const GroupBody& body, const CourseSpace& space) {
    return reach_in(middle, body.radius_m, body.half_m, space);
}

std::vector<Vec3> find_course(const Vec3& from, const Vec3& to, const GroupBody& body, const CourseSpace& space) {
    const double length_m = glm::distance(from, to);
    if (length_m <= 1e-9) return {from, to};
    const double step_m = 0.5 * space.keep_m;
    if (price_of_line(from, to, step_m, body, space) <= length_m * (1.0 + 1e-12)) return {from, to};
    const Grid grid = grid_around(from, to, body, space);
    const std::vector<Vec3> way = cheapest(grid, from, to, body, space);
    return way.size() < 2 ? std::vector<Vec3>{from, to} : shortened(way, step_m, body, space);
}

}  // namespace aerogram::planner
