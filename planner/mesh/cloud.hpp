#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "geo/run.hpp"
#include "planner/mesh/tetrahedra.hpp"
#include "planner/mesh/triangle_mesh.hpp"
#include "planner/sampling/density_field.hpp"

namespace aerogram::planner {

/// Small pieces of a surface or volume, each as one place, in the order of a line that folds through space.
struct Cloud {
    struct Piece {
        Vec3 at{};
        std::uint32_t of = 0;  ///< the triangle or tetrahedron that holds it
        double size = 0.0;     ///< area or volume
        double mass = 0.0;     ///< size times density: how many points it is worth
    };
    std::vector<Piece> pieces;
    double size = 0.0, mass = 0.0;  ///< of all; > 0
    int dimension = 2;              ///< 2: a surface, 3: a volume
};

/// @param pieces  about how many. @param density  pieces where it is 0 are left out; 0 everywhere counts as even.
/// Cost: O(n log n) for n pieces and triangles; at most twice the pieces are kept.
[[nodiscard]] Cloud cloud_of(const TriangleMesh& mesh, std::size_t pieces, const DensityField& density);
[[nodiscard]] Cloud cloud_of(const TetrahedralMesh& inside, std::size_t pieces, const DensityField& density);

/// How many pieces are fine enough for `count` points.
[[nodiscard]] std::size_t pieces_for(std::size_t count);

/// Numbers of `count` pieces (some perhaps more than once), equally far apart by mass along the line.
[[nodiscard]] std::vector<std::size_t> spread_by_mass(const Cloud& cloud, std::size_t count);

/// Brings site i near to `centre` on the surface or in the volume; `piece` is the piece of its cell nearest to it.
using Settle = std::function<Vec3(std::size_t i, const Vec3& centre, const Cloud::Piece& piece)>;

/// Moves sites to the centres of mass of their Voronoi cells, as lloyd.hpp does in the plane, weighted such that the
/// sites come to stand as densely as the pieces' masses ask for.
/// @param sites  at least one; the first `fixed` stay. Cost: O(pieces + sites) a round.
void relax(Points& sites, std::size_t fixed, const Cloud& cloud, std::size_t rounds, const Settle& settle,
           const Run& run);

/// The mean distance of all places from the nearest point, by mass. @param points  at least one.
[[nodiscard]] double mean_distance(const Cloud& cloud, const Points& points);

}  // namespace aerogram::planner
