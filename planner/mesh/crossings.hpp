#pragma once
#include <cstddef>
#include <cstdint>
#include <utility>

#include "planner/mesh/triangle_mesh.hpp"

namespace aerogram::planner {

/// Pairs of triangles that have more in common than the corners or the edge they share (touching counts).
struct Crossings {
    std::size_t pairs = 0;
    std::pair<std::uint32_t, std::uint32_t> first{};  ///< the lowest pair of triangles
    bool gave_up = false;                             ///< more boxes meet than may be looked at; then nothing is known
};

/// @param mesh  finite vertices, indices in range; triangles without area are passed over.
/// @param most_pairs  of triangles whose boxes meet.
/// Exact predicates (CGAL). Cost: O(n log³ n) plus 0.1-1 µs a pair of boxes that meet (about 10 a triangle in a tidy
/// mesh).
[[nodiscard]] Crossings crossings_of(const TriangleMesh& mesh, std::size_t most_pairs);

}  // namespace aerogram::planner
