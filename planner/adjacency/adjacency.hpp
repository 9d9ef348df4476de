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

/// Edges of the Delaunay triangulation of the points (CGAL; tetrahedra, or triangles of a flat formation, or the chain
/// of a collinear one), weighted 1/distance. Within a quarter of the spacing (median distance to the nearest other
/// point) a formation counts as flat, or as straight. Points on one circle or sphere (grids, letters, spheres) leave
/// the triangulation undecided: such cells stay whole, without diagonals, so that symmetric formations have symmetric
/// graphs. Edges that only spheres ten times the formation's size make Delaunay (slivers on its hull) are dropped, and
/// in formations less than two spacings thick those longer than three times the spacing at their ends; never where that
/// disconnects the graph. Coincident points are joined to one another, as strongly as the closest others, and one of
/// them has the neighbours.
/// @param points_m  n >= 1 finite points; any n, any degeneracy.
/// Properties: (1) connected (2) permuting the points permutes the graph (generic input) (3) rigid motions leave it
/// alone (4) every edge that is not between coincident points is a Delaunay edge of the formation, or of its flat
/// projection.
/// Cost: O(n log n) typically; 10,000 points 0.05-1.5 s (exact ties, as in a turned lattice, are the slow ones).
/// Source: Takahashi et al. 2009, section 3.1.
AdjacencyGraph delaunay_adjacency(std::span<const Vec3> points_m);

/// The graph after the designer's words: weights between members of a group multiplied by its weight (of every group
/// that holds both), then [[adjacency]] edits in file order: each edit multiplies what is there, cuts with weight 0,
/// and joins pairs without an edge by its weight times 1/distance (at most the strongest default edge). Groups stand
/// for all pairs of their members. May disconnect.
/// @param points_m  indexed by DRONE (not slot): point i is where drone i is, so that groups keep their members.
AdjacencyGraph edited_adjacency(const AdjacencyGraph& graph, std::span<const Vec3> points_m,
                                const std::vector<Group>& groups, const std::vector<AdjacencyEdit>& edits);

}  // namespace aerogram::planner
