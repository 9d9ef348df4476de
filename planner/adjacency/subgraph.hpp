#pragma once
#include <cstdint>
#include <span>

#include "planner/adjacency/adjacency.hpp"

namespace aerogram::planner {

/// The edges between members, as a graph over them: result vertex i is members[i].
/// @param members  distinct, each < graph.n.
[[nodiscard]] AdjacencyGraph induced_subgraph(const AdjacencyGraph& graph, std::span<const std::uint32_t> members);

/// The graph of wholes: vertices with the same owner become one, weights between two owners are added up, edges inside
/// an owner vanish. Its Laplacian is Pᵀ L P (P: vertex to owner), that is the drones' Laplacian restricted to motions
/// that move every whole as one, so a designer's edits between members act between wholes.
/// @param owner  one a vertex, each < count.
/// Properties: (1) the Laplacian is Pᵀ L P (2) a connected graph stays connected.
[[nodiscard]] AdjacencyGraph contracted_graph(const AdjacencyGraph& graph, std::span<const std::uint32_t> owner,
                                              std::size_t count);

/// The connected component of every vertex; components count up by their lowest vertex.
[[nodiscard]] std::vector<std::uint32_t> components_of(const AdjacencyGraph& graph);

}  // namespace aerogram::planner
