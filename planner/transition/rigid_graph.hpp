#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "planner/adjacency/adjacency.hpp"

namespace aerogram::planner {

/// The neighbours of every individual in either of two keyframes, listed individual by individual.
struct RingGraph {
    std::size_t n = 0;
    std::vector<std::uint32_t> starts;      ///< n + 1: individual i's ring is [starts[i], starts[i + 1])
    std::vector<std::uint32_t> neighbours;  ///< ascending inside a ring
    std::vector<double> weights;            ///< by neighbour, > 0
    std::vector<std::uint32_t> component;   ///< by individual; numbered by lowest individual
    std::vector<std::uint32_t> first_of;    ///< the lowest individual of each component
};

/// The union of two graphs of the same individuals; an edge of both has the mean of its weights.
[[nodiscard]] RingGraph ring_graph(const AdjacencyGraph& source, const AdjacencyGraph& target);

}  // namespace aerogram::planner
