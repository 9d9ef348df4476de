#pragma once
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "geo/vec3.hpp"

namespace aerogram::planner {

/// An edge of a triangulation; its ring is every vertex that closes a triangle with it.
struct DelaunayEdge {
    std::uint32_t a = 0, b = 0;  ///< a < b
    std::size_t ring_begin = 0, ring_end = 0;
};

struct Delaunay {
    std::vector<DelaunayEdge> edges;
    std::vector<std::uint32_t> rings;                              ///< edge e's ring: [ring_begin, ring_end)
    std::vector<std::pair<std::uint32_t, std::uint32_t>> doubles;  ///< (vertex, point at exactly the same coordinates)

    [[nodiscard]] std::span<const std::uint32_t> ring(const DelaunayEdge& e) const {
        return std::span(rings).subspan(e.ring_begin, e.ring_end - e.ring_begin);
    }
};

/// Delaunay triangulation of the plane, exact predicates (CGAL). @param points_m  finite, not all on one line.
Delaunay delaunay_in_plane(std::span<const Vec2> points_m);
/// Delaunay tetrahedralisation, exact predicates (CGAL). @param points_m  finite, not all in one plane.
Delaunay delaunay_in_space(std::span<const Vec3> points_m);

}  // namespace aerogram::planner
