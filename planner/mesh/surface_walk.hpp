#pragma once
#include <cstdint>
#include <vector>

#include "planner/mesh/triangle_mesh.hpp"

namespace aerogram::planner {

/// The place of triangle abc nearest to p, as shares of its corners (>= 0, their sum 1).
[[nodiscard]] Vec3 nearest_shares(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// A place on a mesh.
struct SurfacePlace {
    Vec3 at{};
    std::uint32_t triangle = 0;
};

/// Moves places along a surface from triangle to triangle, so that nothing jumps from one side of a thin wall to the
/// other. The mesh must outlive it.
class SurfaceWalk {
  public:
    explicit SurfaceWalk(const TriangleMesh& mesh);

    [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }

    /// The place nearest to `wanted` that is found going downhill from `from`'s triangle over shared edges and
    /// vertices.
    [[nodiscard]] SurfacePlace towards(const SurfacePlace& from, const Vec3& wanted) const;

    /// Of length 1; zero for a triangle without area.
    [[nodiscard]] const Vec3& normal(std::uint32_t triangle) const { return normals_[triangle]; }

  private:
    const TriangleMesh& mesh_;
    Points normals_;
    std::vector<std::uint32_t> starts_, around_;  ///< the triangles at each vertex
};

}  // namespace aerogram::planner
