#pragma once
#include <cstdint>
#include <vector>

#include "planner/mesh/triangle_mesh.hpp"

namespace aerogram::planner {

/// A line of sharp edges from one corner to the next, or one that closes upon itself.
struct SharpLine {
    std::vector<std::uint32_t> vertices;  ///< a closed line's first vertex is its last again
    bool closed = false;                  ///< without a corner
};

/// The edges of a mesh where its surface turns by more than 30 degrees, ends, or branches.
struct SharpEdges {
    std::vector<SharpLine> lines;
    std::vector<std::uint32_t> corners;  ///< where lines end: other than two meet, or they turn by more than 30 degrees
    std::vector<std::uint32_t> tips;     ///< corners where three or more lines meet, and spikes like a cone's
};
/// Cost: O(n log n) for n triangles.
[[nodiscard]] SharpEdges sharp_edges_of(const TriangleMesh& mesh);

/// A line of points by the distance along it.
class LineTrack {
  public:
    LineTrack(const TriangleMesh& mesh, const SharpLine& line);

    [[nodiscard]] double length() const { return along_.back(); }
    [[nodiscard]] bool closed() const { return closed_; }
    /// @param distance  beyond the ends: the end; closed lines go round.
    [[nodiscard]] Vec3 at(double distance) const;

  private:
    Points points_;
    std::vector<double> along_;
    bool closed_;
};

}  // namespace aerogram::planner
