#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "geo/result.hpp"
#include "geo/run.hpp"
#include "planner/mesh/triangle_mesh.hpp"

namespace aerogram::planner {

struct TetrahedralMesh {
    Points vertices;
    std::vector<std::array<std::uint32_t, 4>> tetrahedra;
    std::vector<std::array<std::uint32_t, 2>> edges;  ///< smaller index first, ascending
};

/// The inside of a closed surface as tetrahedra of good shape and positive volume (TetGen: radius-edge ratio <= 2, but
/// beside edges where the surface is sharp or its own triangles are needles). Where surfaces are nested, what faces the
/// inside of an inner one decides whether that is a cave.
/// @param most_volume  > 0: no tetrahedron larger. @param surface  without faults (mesh_faults.hpp).
/// TetGen runs in a child process with limits on memory and time, so that none of its crashes is ours.
/// Errors: invalid_input when the surface has faults or TetGen gives up (its reason); stopped.
/// Cost: 8,000 triangles 0.5 s, 130,000 11 s of processor time; 4 µs a tetrahedron more.
Result<TetrahedralMesh> tetrahedralise(const TriangleMesh& surface, double most_volume, const Run& run);

/// Tetrahedra between all points and around walls, such that no edge passes through a wall; the first vertices are
/// `points`, in their order. The hull of everything is filled.
/// @param points  finite, distinct, outside the walls. @param walls  closed surfaces without faults.
/// Walls are apart from each other. Where a wall cannot be kept otherwise there are more vertices after these.
/// Errors: as above.
Result<TetrahedralMesh> tetrahedralise_around(const Points& points, const std::vector<TriangleMesh>& walls,
                                              const Run& run);

}  // namespace aerogram::planner
