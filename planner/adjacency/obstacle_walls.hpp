#pragma once
#include <span>
#include <vector>

#include "geo/airspace.hpp"
#include "geo/result.hpp"
#include "geo/run.hpp"
#include "geo/vec3.hpp"
#include "planner/adjacency/adjacency.hpp"
#include "planner/adjacency/obstacle_vertices.hpp"
#include "planner/mesh/triangle_mesh.hpp"

namespace aerogram::planner {

/// Whether the straight way between two places passes through an obstacle's inside; touching it does not count.
[[nodiscard]] bool passes_through(const geo::Obstacle& obstacle, const Vec3& from_m, const Vec3& to_m);

/// An obstacle as a closed surface; a cylinder becomes a prism around it.
/// @param sides  of the cylinder's prism, >= 3: its corners are 1 / cos(pi / sides) radii from the axis.
[[nodiscard]] TriangleMesh wall_of(const geo::Obstacle& obstacle, std::size_t sides = 24);

/// obstacle_adjacency without edges that pass through an obstacle (an edge to an obstacle's own vertex may end in it).
/// Where drones lose an edge so, edges of the constrained tetrahedralisation around the obstacles (TetGen) come in
/// between those that lost one, weighted 1/distance: pairs that see each other and have nobody between them (in the
/// ball over the edge as diameter) whom both see. May disconnect: a wall may part a formation.
/// @param drones_m  finite; one inside an obstacle, or nearer than 1 mm to it, gets no new edge.
/// @param solids  all obstacles, whether they are vertices or not. Where they overlap, only the first of those that do
/// is a wall of the tetrahedralisation; edges through any are left out all the same.
/// Properties: (1) no edge passes through an obstacle (2) without an edge in the way it is obstacle_adjacency (3) only
/// edges between drones that lost one are new.
/// Errors: those of tetrahedralise_around; stopped. Cost: TetGen's, 10,000 drones 0.5 s, and nothing without an
/// edge in the way.
Result<AdjacencyGraph> adjacency_around(std::span<const Vec3> drones_m, std::span<const ObstacleVertex> vertices,
                                        const std::vector<geo::Obstacle>& solids, const Run& run);

}  // namespace aerogram::planner
