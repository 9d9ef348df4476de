#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include "planner/adjacency/formation_shape.hpp"
#include "planner/adjacency/obstacle_walls.hpp"
#include "planner/mesh/mesh_faults.hpp"
#include "planner/mesh/tetrahedra.hpp"

namespace aerogram::planner {
namespace {

/// Nearer than this to an obstacle a drone is no vertex of the tetrahedralisation: TetGen needs room.
constexpr double kRoom_m = 1e-3;
/// Cylinders get more sides until every drone outside the cylinder is outside its prism.
constexpr std::size_t kFewestSides = 24, kMostSides = 768;
/// A ball over an edge reaches this much farther, so that the corners of a square count as between its others.
constexpr double kBallShare = 2e-3;

using Obstacles = std::vector<geo::Obstacle>;

/// A box with room for rounding, to pass over obstacles that are nowhere near.
struct Reach {
    Vec2 low{}, high{};

    explicit Reach(const geo::Obstacle& o) {
        if (const auto* c = std::get_if<geo::Cylinder>(&o.shape)) {
            low = c->center_m - c->radius_m;
            high = c->center_m + c->radius_m;
            return;
        }
        const geo::Polygon& outline = std::get<geo::Prism>(o.shape).outline_m;
        low = high = outline.front();
        for (const Vec2& p : outline) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
    }
    [[nodiscard]] bool misses(const Vec3& a, const Vec3& b) const {
        return std::max(a.x, b.x) < low.x || std::min(a.x, b.x) > high.x || std::max(a.y, b.y) < low.y ||
               std::min(a.y, b.y) > high.y;
    }
};

class Around {
  public:
    Around(std::span<const Vec3> drones_m, std::span<const ObstacleVertex> vertices, const Obstacles& solids)
        : drones_m_(drones_m),
          vertices_(vertices),
          solids_(solids),
          crossed_(solids.size(), false),
          lost_(drones_m.size(), false) {
        for (const geo::Obstacle& o : solids) reaches_.emplace_back(o);
    }

    /// Takes the edges out that something is in the way of. @returns whether drones have lost one.
    bool cut(AdjacencyGraph& graph) {
        bool any = false;
        const auto blocked = [&](const Edge& e) {
            bool through = false;
            for (std::size_t o = 0; o < solids_.size(); ++o) {
                if (!hides(o, e.a, e.b)) continue;
                through = true;
                if (e.b < drones_m_.size()) lost_[e.a] = lost_[e.b] = crossed_[o] = any = true;
            }
            return through;
        };
        std::erase_if(graph.edges, blocked);
        return any;
    }

    /// Puts edges of the tetrahedralisation in between drones that have lost one.
    Status mend(AdjacencyGraph& graph, const Run& run) {
        std::vector<std::uint32_t> who;
        const Points points = free_places(who);
        const auto mesh = tetrahedralise_around(points, walls(points), run);
        if (!mesh) return mesh.error();
        std::vector<Edge> fresh;
        for (const auto& [i, j] : mesh->edges) {
            if (j >= who.size() || !lost_[who[i]] || !lost_[who[j]]) continue;
            const std::uint32_t a = std::min(who[i], who[j]), b = std::max(who[i], who[j]);
            if (has_edge(graph, a, b) || !see(a, b) || somebody_between(points, who, a, b)) continue;
            fresh.push_back({a, b, 1.0 / glm::length(drones_m_[b] - drones_m_[a])});
        }
        graph.edges.insert(graph.edges.end(), fresh.begin(), fresh.end());
        std::sort(graph.edges.begin(), graph.edges.end(), before);
        return Done{};
    }

  private:
    static bool before(const Edge& p, const Edge& q) { return std::pair(p.a, p.b) < std::pair(q.a, q.b); }
    static bool has_edge(const AdjacencyGraph& graph, std::uint32_t a, std::uint32_t b) {
        return std::binary_search(graph.edges.begin(), graph.edges.end(), Edge{a, b, 0.0}, before);
    }

    [[nodiscard]] const Vec3& place(std::uint32_t vertex) const {
        return vertex < drones_m_.size() ? drones_m_[vertex] : vertices_[vertex - drones_m_.size()].at_m;
    }
    [[nodiscard]] bool stands_in(std::uint32_t vertex, std::size_t obstacle) const {
        return vertex >= drones_m_.size() && vertices_[vertex - drones_m_.size()].obstacle == obstacle;
    }
    [[nodiscard]] bool hides(std::size_t obstacle, std::uint32_t a, std::uint32_t b) const {
        return !reaches_[obstacle].misses(place(a), place(b)) && !stands_in(a, obstacle) && !stands_in(b, obstacle) &&
               passes_through(solids_[obstacle], place(a), place(b));
    }
    [[nodiscard]] bool see(std::uint32_t a, std::uint32_t b) const {
        for (std::size_t o = 0; o < solids_.size(); ++o)
            if (hides(o, a, b)) return false;
        return true;
    }

    /// Somebody whom both see, in the ball that has the edge as its diameter.
    [[nodiscard]] bool somebody_between(const Points& points, const std::vector<std::uint32_t>& who, std::uint32_t a,
                                        std::uint32_t b) const {
        const Vec3 middle = 0.5 * (drones_m_[a] + drones_m_[b]);
        const double radius_m = 0.5 * (1.0 + kBallShare) * glm::length(drones_m_[b] - drones_m_[a]);
        for (std::size_t k = 0; k < points.size(); ++k) {
            if (who[k] == a || who[k] == b || glm::length(points[k] - middle) > radius_m) continue;
            if (see(a, who[k]) && see(b, who[k])) return true;
        }
        return false;
    }

    /// Where drones are free of every obstacle, each place once.
    Points free_places(std::vector<std::uint32_t>& who) const {
        const std::vector<std::uint32_t> first = same_place(drones_m_);
        Points points;
        for (std::uint32_t d = 0; d < drones_m_.size(); ++d) {
            const bool free = std::all_of(solids_.begin(), solids_.end(), [&](const geo::Obstacle& o) {
                return geo::clearance(o, drones_m_[d]) > kRoom_m;
            });
            if (first[d] != d || !free) continue;
            who.push_back(d);
            points.push_back(drones_m_[d]);
        }
        return points;
    }

    static std::size_t sides_for(const geo::Obstacle& obstacle, const Points& points) {
        const auto* cylinder = std::get_if<geo::Cylinder>(&obstacle.shape);
        std::size_t sides = kFewestSides;
        if (cylinder == nullptr) return sides;
        double nearest_m = HUGE_VAL;
        for (const Vec3& p : points)
            if (p.z > obstacle.base_m - kRoom_m && p.z < obstacle.base_m + obstacle.height_m + kRoom_m)
                nearest_m = std::min(nearest_m, glm::length(Vec2{p.x, p.y} - cylinder->center_m));
        while (sides < kMostSides &&
               cylinder->radius_m / std::cos(std::numbers::pi / static_cast<double>(sides)) >= nearest_m)
            sides *= 2;
        return sides;
    }

    /// Of the obstacles in the way those that are apart from each other.
    std::vector<TriangleMesh> walls(const Points& points) const {
        std::vector<TriangleMesh> apart;
        TriangleMesh all;
        for (std::size_t o = 0; o < solids_.size(); ++o) {
            if (!crossed_[o]) continue;
            TriangleMesh wall = wall_of(solids_[o], sides_for(solids_[o], points)), both = all;
            const auto offset = static_cast<std::uint32_t>(all.vertices.size());
            both.vertices.insert(both.vertices.end(), wall.vertices.begin(), wall.vertices.end());
            for (const auto& [a, b, c] : wall.triangles) both.triangles.push_back({a + offset, b + offset, c + offset});
            if (!apart.empty() && !faults_of(both).empty()) continue;
            all = std::move(both);
            apart.push_back(std::move(wall));
        }
        return apart;
    }

    std::span<const Vec3> drones_m_;
    std::span<const ObstacleVertex> vertices_;
    const Obstacles& solids_;
    std::vector<Reach> reaches_;
    std::vector<bool> crossed_;  ///< by obstacle: an edge between drones passed through it
    std::vector<bool> lost_;     ///< by drone
};

}  // namespace

Result<AdjacencyGraph> adjacency_around(std::span<const Vec3> drones_m, std::span<const ObstacleVertex> vertices,
                                        const Obstacles& solids, const Run& run) {
    AdjacencyGraph graph = obstacle_adjacency(drones_m, vertices);
    Around around(drones_m, vertices, solids);
    if (!around.cut(graph)) return graph;
    if (auto done = around.mend(graph, run); !done) return done.error();
    return graph;
}

}  // namespace aerogram::planner
