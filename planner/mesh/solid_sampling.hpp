#pragma once
#include <cstddef>

#include "geo/run.hpp"
#include "planner/mesh/tetrahedra.hpp"
#include "planner/mesh/triangle_mesh.hpp"
#include "planner/sampling/density_field.hpp"

namespace aerogram::planner {

/// Exactly `count` points spread evenly over a surface: Lloyd's relaxation on the surface, then pushed apart along it.
/// @param mesh  with some area, at its final proportions; corners where three sharp edges meet are occupied when there
/// are enough points. @param density  in the mesh's own coordinates.
/// Properties: (1) count exact (2) on the surface to 1e-9 of its size (3) deterministic. Cost: 10,000 points 2 s.
[[nodiscard]] Points sample_surface(const TriangleMesh& mesh, std::size_t count, const DensityField& density,
                                    const Run& run);

/// Exactly `count` points spread evenly through a volume, its skin included: Lloyd's relaxation in tetrahedra.
/// Properties as above, (2) inside or on the skin. @param inside  with some volume.
[[nodiscard]] Points sample_volume(const TetrahedralMesh& inside, std::size_t count, const DensityField& density,
                                   const Run& run);

/// Exactly `count` points along the sharp edges (more than 30 degrees), corners first, equal steps between.
/// @param mesh  with a sharp edge.
[[nodiscard]] Points sample_edges(const TriangleMesh& mesh, std::size_t count);
[[nodiscard]] bool has_sharp_edges(const TriangleMesh& mesh);

/// Paper 003, equation 4, as a mean: how far a place of the surface or volume is from the nearest drone.
[[nodiscard]] double mean_distance(const TriangleMesh& mesh, const Points& points);
[[nodiscard]] double mean_distance(const TetrahedralMesh& inside, const Points& points);

}  // namespace aerogram::planner
