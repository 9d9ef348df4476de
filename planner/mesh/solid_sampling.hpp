#pragma once
#include <cstddef>

#include "geo/run.hpp"
#include "planner/mesh/tetrahedra.hpp"
#include "planner/mesh/triangle_mesh.hpp"
#include "planner/sampling/density_field.hpp"

namespace aerogram::planner {

/// Exactly `count` points spread evenly over a surface: Lloyd's relaxation on the surface, then pushed apart along it.
/// @param mesh  with some area, at its final proportions. Without a density its sharp edges and corners are drawn
/// first, with equal steps, when there are enough points; those of round things in flat facets are not.
/// @param density  in the mesh's own coordinates; 0 all over counts as even.
/// Properties: (1) count exact (2) on the surface to 1e-9 of its size (3) deterministic (4) a density twice as high
/// gives twice as many points. Accuracy: the smallest distance is 0.8 of the hexagonal lattice's and more (100 points
/// and more, no walls thinner than that). Cost: 10,000 points 0.6 s.
[[nodiscard]] Points sample_surface(const TriangleMesh& mesh, std::size_t count, const DensityField& density,
                                    const Run& run);

/// Exactly `count` points spread evenly through a volume: some on its skin, the others by Lloyd's relaxation inside,
/// then all pushed apart. Properties as above, (2) inside or on the skin. @param inside  with some volume.
/// Accuracy: the smallest distance is 0.85 of the densest packing's and more. Cost: 10,000 points 0.9 s.
[[nodiscard]] Points sample_volume(const TetrahedralMesh& inside, std::size_t count, const DensityField& density,
                                   const Run& run);

/// Exactly `count` points along the sharp edges (more than 30 degrees), corners and tips first, equal steps between
/// (where edges are nearer to each other than a step, their points slide apart).
/// @param mesh  with a sharp edge.
[[nodiscard]] Points sample_edges(const TriangleMesh& mesh, std::size_t count);
[[nodiscard]] bool has_sharp_edges(const TriangleMesh& mesh);

/// Paper 003, equation 4, as a mean: how far a place of the surface or volume is from the nearest drone.
/// @param points  at least one. @param density  how much places count.
[[nodiscard]] double mean_distance(const TriangleMesh& mesh, const Points& points, const DensityField& density = {});
[[nodiscard]] double mean_distance(const TetrahedralMesh& inside, const Points& points,
                                   const DensityField& density = {});

}  // namespace aerogram::planner
