#include "planner/adjacency/subgraph.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "geo/contract.hpp"

namespace aerogram::planner {
namespace {
constexpr std::uint32_t kNobody = std::numeric_limits<std::uint32_t>::max();
}

AdjacencyGraph induced_subgraph(const AdjacencyGraph& graph, std::span<const std::uint32_t> members) {
    std::vector<std::uint32_t> place(graph.n, kNobody);
    for (std::size_t i = 0; i < members.size(); ++i) {
        AEROGRAM_REQUIRE(members[i] < graph.n && place[members[i]] == kNobody, members[i], graph.n);
        place[members[i]] = static_cast<std::uint32_t>(i);
    }
    AdjacencyGraph out{members.size(), {}};
    for (const Edge& e : graph.edges) {
        const std::uint32_t a = place[e.a], b = place[e.b];
        if (a != kNobody && b != kNobody) out.edges.push_back({std::min(a, b), std::max(a, b), e.weight});
    }
    std::sort(out.edges.begin(), out.edges.end(),
              [](const Edge& p, const Edge& q) { return std::pair(p.a, p.b) < std::pair(q.a, q.b); });
    return out;
}

AdjacencyGraph contracted_graph(const AdjacencyGraph& graph, std::span<const std::uint32_t> owner, std::size_t count) {
    AEROGRAM_REQUIRE(owner.size() == graph.n, owner.size(), graph.n);
    std::map<std::pair<std::uint32_t, std::uint32_t>, double> weights;
    for (const Edge& e : graph.edges) {
        const std::uint32_t a = owner[e.a], b = owner[e.b];
        AEROGRAM_REQUIRE(a < count && b < count, a, b, count);
        if (a != b) weights[std::minmax(a, b)] += e.weight;
    }
    AdjacencyGraph out{count, {}};
    for (const auto& [pair, weight] : weights) out.edges.push_back({pair.first, pair.second, weight});
    return out;
}

std::vector<std::uint32_t> components_of(const AdjacencyGraph& graph) {
    std::vector<std::uint32_t> parent(graph.n);
    std::iota(parent.begin(), parent.end(), 0U);
    const auto root = [&](std::uint32_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    for (const Edge& e : graph.edges) {
        const std::uint32_t a = root(e.a), b = root(e.b);
        parent[std::max(a, b)] = std::min(a, b);
    }
    std::vector<std::uint32_t> component(graph.n);
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < graph.n; ++i) component[i] = parent[i] == i ? count++ : component[root(i)];
    return component;
}

}  // namespace aerogram::planner
