#include <algorithm>
#include <map>

#include "planner/adjacency/adjacency.hpp"
#include "planner/adjacency/edge_weight.hpp"

namespace aerogram::planner {
namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;
using Weights = std::map<Pair, double>;

void raise_within(Weights& weights, const Group& group, std::size_t n) {
    AEROGRAM_REQUIRE(group.weight > 0.0, group.weight, group.name);
    std::vector<bool> member(n, false);
    for (const DroneId d : group.drones) {
        AEROGRAM_REQUIRE(d.value < n, d.value, n, group.name);
        member[d.value] = true;
    }
    for (auto& [pair, weight] : weights)
        if (member[pair.first] && member[pair.second]) weight *= group.weight;
}

std::vector<DroneId> drones_of(const AdjacencyEnd& end, const std::vector<Group>& groups) {
    if (const DroneId* drone = std::get_if<DroneId>(&end.who)) return {*drone};
    const std::size_t group = std::get<std::size_t>(end.who);
    AEROGRAM_REQUIRE(group < groups.size(), group, groups.size());
    return groups[group].drones;
}

/// Every unordered pair with one end in each list, once.
std::vector<Pair> pairs_between(const std::vector<DroneId>& first, const std::vector<DroneId>& second) {
    std::vector<Pair> pairs;
    for (const DroneId a : first)
        for (const DroneId b : second)
            if (a != b) pairs.emplace_back(std::min(a, b).value, std::max(a, b).value);
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

void apply(Weights& weights, const AdjacencyEdit& edit, const std::vector<Group>& groups,
           std::span<const Vec3> points_m, double strongest) {
    AEROGRAM_REQUIRE(edit.weight >= 0.0, edit.weight);
    for (const Pair& pair : pairs_between(drones_of(edit.first, groups), drones_of(edit.second, groups))) {
        AEROGRAM_REQUIRE(pair.second < points_m.size(), pair.second, points_m.size());
        const auto found = weights.find(pair);
        if (edit.weight == 0.0) {
            weights.erase(pair);
        } else if (found != weights.end()) {
            found->second *= edit.weight;
        } else {
            const double distance_m = glm::length(points_m[pair.second] - points_m[pair.first]);
            weights[pair] = edit.weight * std::min(1.0 / distance_m, strongest);
        }
    }
}

}  // namespace

AdjacencyGraph edited_adjacency(const AdjacencyGraph& graph, std::span<const Vec3> points_m,
                                const std::vector<Group>& groups, const std::vector<AdjacencyEdit>& edits) {
    AEROGRAM_REQUIRE(graph.n == points_m.size(), graph.n, points_m.size());
    const double strongest = strongest_weight(graph);
    Weights weights;
    for (const Edge& e : graph.edges) weights[{e.a, e.b}] = e.weight;
    for (const Group& group : groups) raise_within(weights, group, graph.n);
    for (const AdjacencyEdit& edit : edits) apply(weights, edit, groups, points_m, strongest);
    AdjacencyGraph edited{graph.n, {}};
    for (const auto& [pair, weight] : weights) edited.edges.push_back({pair.first, pair.second, weight});
    return edited;
}

}  // namespace aerogram::planner
