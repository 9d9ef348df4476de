#pragma once
#include <string>

#include "planner/mesh/triangle_mesh.hpp"

namespace aerogram::planner {

/// What keeps a surface from enclosing a volume, in words with places ("is open: 12 edges without a second triangle,
/// the first from (0, 0, 1) to (1, 0, 1)"): open edges, edges of more than two triangles, triangles that disagree about
/// the outside, triangles without area, triangles that pass through or touch each other. Empty: it encloses one.
/// Cost: 3 s for a million triangles; where more than 200 million pairs of boxes around triangles meet, it says that it
/// has not looked.
[[nodiscard]] std::string faults_of(const TriangleMesh& mesh);

/// The mesh with each connected piece's triangles turned so that the volume it encloses is positive.
/// @param mesh  closed, whatever its orientation.
[[nodiscard]] TriangleMesh turned_outwards(TriangleMesh mesh);

}  // namespace aerogram::planner
