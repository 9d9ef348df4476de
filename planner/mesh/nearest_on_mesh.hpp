#pragma once
#include <cstdint>
#include <vector>

#include "planner/mesh/triangle_mesh.hpp"

namespace aerogram::planner {

/// A place on a mesh by one of its triangles and shares of that triangle's corners (>= 0, their sum 1).
struct MeshPlace {
    std::uint32_t triangle = 0;
    Vec3 shares{1.0, 0.0, 0.0};
};

[[nodiscard]] Vec3 position_of(const MeshPlace& place, const TriangleMesh& mesh);
/// Between the colours of the triangle's corners. @param mesh  with colours.
[[nodiscard]] Rgb color_of(const MeshPlace& place, const TriangleMesh& mesh);

/// Finds the nearest place of a mesh to any place in space; a tree of boxes. The mesh must outlive it.
class NearestOnMesh {
  public:
    /// @param mesh  with at least one triangle. Cost: O(n log n).
    explicit NearestOnMesh(const TriangleMesh& mesh);

    /// Of equally near triangles the lowest. Cost: O(log n) for places near the surface.
    [[nodiscard]] MeshPlace nearest(const Vec3& p) const;

  private:
    struct Node {
        Vec3 low{}, high{};
        std::uint32_t first = 0, count = 0;  ///< a leaf's triangles in order_; others have none
        std::uint32_t second = 0;            ///< the second child; the first is the next node
    };
    std::uint32_t build(std::uint32_t first, std::uint32_t count, const Points& centres);
    void seek(std::uint32_t node, const Vec3& p, double& squared, MeshPlace& best) const;

    const TriangleMesh& mesh_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

}  // namespace aerogram::planner
