#include "planner/adjacency/obstacle_vertices.hpp"

#include <algorithm>
#include <variant>

#include "geo/contract.hpp"

namespace aerogram::planner {
namespace {

double mean_height(std::span<const Vec3> points_m) {
    double sum = 0.0;
    for (const Vec3& p : points_m) sum += p.z;
    return points_m.empty() ? 0.0 : sum / static_cast<double>(points_m.size());
}

Vec2 area_barycentre(const geo::Polygon& outline_m) {
    Vec2 sum{};
    double twice_area = 0.0;
    for (std::size_t i = 0; i < outline_m.size(); ++i) {
        const Vec2 a = outline_m[i] - outline_m[0], b = outline_m[(i + 1) % outline_m.size()] - outline_m[0];
        const double cross = a.x * b.y - a.y * b.x;
        twice_area += cross;
        sum += cross * (a + b);
    }
    AEROGRAM_REQUIRE(twice_area != 0.0, outline_m.size());
    return outline_m[0] + sum / (3.0 * twice_area);
}

Vec2 axis_of(const geo::Obstacle& obstacle) {
    if (const auto* cylinder = std::get_if<geo::Cylinder>(&obstacle.shape)) return cylinder->center_m;
    return area_barycentre(std::get<geo::Prism>(obstacle.shape).outline_m);
}

}  // namespace

std::vector<ObstacleVertex> obstacle_vertices(const std::vector<geo::Obstacle>& obstacles,
                                              std::span<const double> weights, std::span<const Vec3> from_m,
                                              std::span<const Vec3> to_m) {
    AEROGRAM_REQUIRE(obstacles.size() == weights.size(), obstacles.size(), weights.size());
    const double height_m = 0.5 * (mean_height(from_m) + mean_height(to_m));
    std::vector<ObstacleVertex> out;
    for (std::size_t j = 0; j < obstacles.size(); ++j) {
        AEROGRAM_REQUIRE(weights[j] >= 0.0, j, weights[j]);
        if (weights[j] == 0.0) continue;
        const geo::Obstacle& o = obstacles[j];
        const Vec2 axis = axis_of(o);
        out.push_back({{axis.x, axis.y, std::clamp(height_m, o.base_m, o.base_m + o.height_m)}, weights[j], j});
    }
    return out;
}

AdjacencyGraph obstacle_adjacency(std::span<const Vec3> drones_m, std::span<const ObstacleVertex> obstacles) {
    Points all(drones_m.begin(), drones_m.end());
    for (const ObstacleVertex& o : obstacles) all.push_back(o.at_m);
    AdjacencyGraph graph = delaunay_adjacency(all);
    for (Edge& e : graph.edges) {
        for (const std::uint32_t i : {e.a, e.b}) {
            if (i >= drones_m.size()) e.weight *= obstacles[i - drones_m.size()].weight;
        }
    }
    return graph;
}

}  // namespace aerogram::planner
