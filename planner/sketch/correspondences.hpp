#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "planner/sketch/coordinate_tree.hpp"

namespace aerogram::planner {

/// Of an agent that takes no part.
inline constexpr std::uint32_t kElsewhere = kNobody - 1;

/// Pairs that may not be, and agents and points that are no longer free.
struct CorrespondenceRules {
    std::vector<std::vector<std::uint32_t>> forbidden_points;  ///< by agent, ascending; empty: none for anybody
    std::vector<std::vector<std::uint32_t>> forbidden_agents;  ///< by point: the same pairs
    std::vector<std::uint32_t> taken_point_of;  ///< by agent: its point, kNobody or kElsewhere; empty: all are free
};

/// Which point each agent takes (paper 002, section 3.4): first every boundary point, in order, takes the nearest agent
/// in coordinate space, one and only one; then every other agent, in order, takes the nearest point that is free.
/// @param boundary  how many of the points, the first, are on the boundary. Ties go to the lowest index.
/// Properties: (1) nobody shares a point (2) boundary points are taken, as long as there are agents (3) rules are kept
/// (4) same input, same result. An agent for whom no free point is left has kNobody (never with at least as many points
/// as agents and without rules), and so has one that is elsewhere. Cost: O(n log n) as a rule.
[[nodiscard]] std::vector<std::uint32_t> find_correspondences(std::span<const FormationCoordinate> agents,
                                                              std::span<const FormationCoordinate> points,
                                                              std::size_t boundary,
                                                              const CorrespondenceRules& rules = {});

}  // namespace aerogram::planner
