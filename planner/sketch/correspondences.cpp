#include "planner/sketch/correspondences.hpp"

#include "geo/contract.hpp"

namespace aerogram::planner {
namespace {

std::span<const std::uint32_t> row(const std::vector<std::vector<std::uint32_t>>& table, std::size_t i) {
    return table.empty() ? std::span<const std::uint32_t>{} : table[i];
}

}  // namespace

std::vector<std::uint32_t> find_correspondences(std::span<const FormationCoordinate> agents,
                                                std::span<const FormationCoordinate> points, std::size_t boundary,
                                                const CorrespondenceRules& rules) {
    AEROGRAM_REQUIRE(boundary <= points.size(), boundary, points.size());
    CoordinateTree free_agents(agents), free_points(points);
    std::vector<std::uint32_t> point_of(agents.size(), kNobody);
    std::vector<bool> taken(points.size(), false);
    const auto pair = [&](std::uint32_t agent, std::uint32_t point) {
        point_of[agent] = point;
        taken[point] = true;
        free_agents.remove(agent);
        free_points.remove(point);
    };
    const auto elsewhere = [&](std::uint32_t agent) {
        return !rules.taken_point_of.empty() && rules.taken_point_of[agent] == kElsewhere;
    };
    for (std::uint32_t a = 0; a < rules.taken_point_of.size(); ++a) {
        if (elsewhere(a)) {
            free_agents.remove(a);
        } else if (rules.taken_point_of[a] != kNobody) {
            pair(a, rules.taken_point_of[a]);
        }
    }
    for (std::uint32_t p = 0; p < boundary; ++p) {
        if (taken[p]) continue;
        const std::uint32_t agent = free_agents.nearest(points[p], row(rules.forbidden_agents, p));
        if (agent != kNobody) pair(agent, p);
    }
    for (std::uint32_t a = 0; a < agents.size(); ++a) {
        if (point_of[a] != kNobody || elsewhere(a)) continue;
        const std::uint32_t point = free_points.nearest(agents[a], row(rules.forbidden_points, a));
        if (point != kNobody) pair(a, point);
    }
    return point_of;
}

}  // namespace aerogram::planner
