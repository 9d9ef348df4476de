#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "geo/result.hpp"
#include "geo/run.hpp"
#include "geo/vec3.hpp"

namespace aerogram::planner {

inline constexpr double kRadiusEdgeRatio = 2.0;

/// What TetGen gets. The caller has looked: finite, distinct, not flat, facets that do not pass through each other.
struct TetgenInput {
    Points vertices;
    std::vector<std::array<std::uint32_t, 3>> facets;
    double most_volume = 0.0;  ///< > 0: tetrahedra of good shape and no larger; 0: only the vertices (and few more)
    bool fill_hull = false;    ///< between the facets and their convex hull too
};

struct TetgenOutput {
    Points vertices;  ///< those of the input first
    std::vector<std::array<std::uint32_t, 4>> tetrahedra;
    std::vector<std::int32_t>
        regions;  ///< by tetrahedron: which of the spaces that facets keep apart (most_volume > 0)
};

/// TetGen in a child process with limits. Errors: invalid_input when it gives up or crashes; io; stopped.
Result<TetgenOutput> run_tetgen(const TetgenInput& input, const Run& run);

}  // namespace aerogram::planner
