#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "planner/mesh/tetrahedra.hpp"
#include "planner/mesh/triangle_mesh.hpp"

namespace aerogram::planner {

/// A place in a tetrahedral mesh.
struct VolumePlace {
    Vec3 at{};
    std::uint32_t tetrahedron = 0;
};

/// Moves places through a volume from tetrahedron to tetrahedron; at its skin they stop. The mesh must outlive it.
class VolumeWalk {
  public:
    explicit VolumeWalk(const TetrahedralMesh& mesh);

    /// `wanted`, or a place on the skin on the way there.
    [[nodiscard]] VolumePlace towards(const VolumePlace& from, const Vec3& wanted) const;

    /// The faces of only one tetrahedron, seen from outside; the vertices are the mesh's own.
    [[nodiscard]] TriangleMesh skin() const;

  private:
    static constexpr std::uint32_t kOutside = 0xFFFFFFFFU;

    const TetrahedralMesh& mesh_;
    std::vector<std::array<std::uint32_t, 4>> next_;  ///< across the face opposite to each vertex
};

}  // namespace aerogram::planner
