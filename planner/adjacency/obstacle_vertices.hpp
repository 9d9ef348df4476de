#pragma once
#include <span>
#include <vector>

#include "geo/airspace.hpp"
#include "geo/vec3.hpp"
#include "planner/adjacency/adjacency.hpp"

namespace aerogram::planner {

/// An obstacle as a vertex of the graph: where it counts as standing, and how firmly drones keep their place to it.
struct ObstacleVertex {
    Vec3 at_m{};
    double weight = 1.0;       ///< > 0, multiplies 1/distance of its edges
    std::size_t obstacle = 0;  ///< its index among all obstacles
};

/// Where obstacles count as standing on the way between two keyframes: on their upright axis (a prism's: the barycentre
/// of its outline), at the mean height of the two formations' barycentres as far as the solid reaches. One place for
/// both keyframes, or the vertex would move. @param weights  one an obstacle; those of 0 are no vertices.
std::vector<ObstacleVertex> obstacle_vertices(const std::vector<geo::Obstacle>& obstacles,
                                              std::span<const double> weights, std::span<const Vec3> from_m,
                                              std::span<const Vec3> to_m);

/// Edges of the Delaunay triangulation of drones and obstacles together (delaunay_adjacency): vertex i < n is drone i,
/// n + j obstacle j. Edges at obstacles are multiplied by the obstacle's weight, between two obstacles by both.
/// Without obstacles: delaunay_adjacency. A designer's edits come after (edited_adjacency, with all points).
/// Source: Takahashi et al. 2009, section 5.3: obstacles as vertices, clearance by their weights.
AdjacencyGraph obstacle_adjacency(std::span<const Vec3> drones_m, std::span<const ObstacleVertex> obstacles);

}  // namespace aerogram::planner
