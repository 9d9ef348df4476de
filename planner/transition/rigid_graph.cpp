#include "planner/transition/rigid_graph.hpp"

#include <algorithm>

#include "geo/contract.hpp"

namespace aerogram::planner {
namespace {

/// Edges of either graph, by (a, b).
std::vector<Edge> union_of(const AdjacencyGraph& source, const AdjacencyGraph& target) {
    std::vector<Edge> edges;
    edges.reserve(source.edges.size() + target.edges.size());
    auto s = source.edges.begin();
    auto t = target.edges.begin();
    const auto key = [](const Edge& e) { return std::pair(e.a, e.b); };
    while (s != source.edges.end() || t != target.edges.end()) {
        if (t == target.edges.end() || (s != source.edges.end() && key(*s) < key(*t))) {
            edges.push_back(*s++);
        } else if (s == source.edges.end() || key(*t) < key(*s)) {
            edges.push_back(*t++);
        } else {
            edges.push_back({s->a, s->b, 0.5 * (s->weight + t->weight)});
            ++s;
            ++t;
        }
    }
    return edges;
}

void number_components(RingGraph& graph) {
    constexpr std::uint32_t kNone = ~std::uint32_t{0};
    graph.component.assign(graph.n, kNone);
    std::vector<std::uint32_t> reached;
    for (std::uint32_t first = 0; first < graph.n; ++first) {
        if (graph.component[first] != kNone) continue;
        const auto number = static_cast<std::uint32_t>(graph.first_of.size());
        graph.first_of.push_back(first);
        graph.component[first] = number;
        reached.assign(1, first);
        while (!reached.empty()) {
            const std::uint32_t i = reached.back();
            reached.pop_back();
            for (std::uint32_t k = graph.starts[i]; k < graph.starts[i + 1]; ++k) {
                const std::uint32_t j = graph.neighbours[k];
                if (graph.component[j] != kNone) continue;
                graph.component[j] = number;
                reached.push_back(j);
            }
        }
    }
}

}  // namespace

RingGraph ring_graph(const AdjacencyGraph& source, const AdjacencyGraph& target) {
    AEROGRAM_REQUIRE(source.n == target.n, source.n, target.n);
    const std::vector<Edge> edges = union_of(source, target);
    RingGraph graph;
    graph.n = source.n;
    graph.starts.assign(graph.n + 1, 0);
    for (const Edge& e : edges) {
        AEROGRAM_REQUIRE(e.a < e.b && e.b < graph.n && e.weight > 0.0, e.a, e.b, e.weight);
        ++graph.starts[e.a + 1];
        ++graph.starts[e.b + 1];
    }
    for (std::size_t i = 0; i < graph.n; ++i) graph.starts[i + 1] += graph.starts[i];
    graph.neighbours.resize(2 * edges.size());
    graph.weights.resize(2 * edges.size());
    std::vector<std::uint32_t> next(graph.starts.begin(), graph.starts.end() - 1);
    const auto put = [&](std::uint32_t i, std::uint32_t j, double weight) {
        graph.neighbours[next[i]] = j;
        graph.weights[next[i]++] = weight;
    };
    for (const Edge& e : edges) put(e.b, e.a, e.weight);  // lower neighbours first: rings come out ascending
    for (const Edge& e : edges) put(e.a, e.b, e.weight);
    number_components(graph);
    return graph;
}

}  // namespace aerogram::planner
