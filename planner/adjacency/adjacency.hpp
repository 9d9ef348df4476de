#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "geo/result.hpp"
#include "geo/vec3.hpp"
#include "planner/mission/mission.hpp"

namespace aerogram::planner {

struct Edge {
    std::uint32_t a = 0, b = 0;  ///< a < b
    double weight = 0.0;         ///< > 0, 1/m by default
    bool operator==(const Edge&) const = default;
};

/// Who is a neighbour of whom: an undirected weighted graph over n individuals; edges sorted by (a, b), unique.
struct AdjacencyGraph {
    std::size_t n = 0;
    std::vector<Edge> edges;
};

/// Edges of the Delaunay triangulation of the points (CGAL; tetrahedra, or triangles of a flat formation, or the chain of a
/// collinear one), weighted 1/distance. Nearly flat input: edges longer than a multiple of the local spacing are dropped
/// where that keeps the graph connected. Coincident points are joined to one another.
/// @param points_m  n >= 1 finite points; any n, any degeneracy.
/// Properties: (1) connected (2) permuting the points permutes the graph (generic input) (3) rigid motions leave it alone.
/// Source: Takahashi et al. 2009, section 3.1.
AdjacencyGraph delaunay_adjacency(std::span<const Vec3> points_m);

/// The graph after the designer's words: intra-group weights multiplied, then [[adjacency]] edits in file order.
/// @param points_m  indexed by DRONE (not slot): point i is where drone i is, so that groups keep their members.
AdjacencyGraph edited_adjacency(const AdjacencyGraph& graph, std::span<const Vec3> points_m, const std::vector<Group>& groups,
                                const std::vector<AdjacencyEdit>& edits);

}  // namespace aerogram::planner
