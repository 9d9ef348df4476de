#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "geo/color.hpp"
#include "geo/vec3.hpp"

namespace aerogram::planner {

/// A surface of triangles, counter-clockwise seen from outside where it has an outside.
struct TriangleMesh {
    Points vertices;  ///< finite
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<Rgb> colors;  ///< linear, one a vertex; empty: the file has none
};

}  // namespace aerogram::planner
