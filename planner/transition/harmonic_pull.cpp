#include "planner/transition/harmonic_pull.hpp"

#include <map>
#include <utility>
#include <vector>

#include "geo/contract.hpp"
#include "planner/adjacency/subgraph.hpp"
#include "planner/transition/sparse.hpp"

namespace aerogram::planner {
namespace {

AdjacencyGraph mean_of(const AdjacencyGraph& a, const AdjacencyGraph& b) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, double> weights;
    for (const AdjacencyGraph* graph : {&a, &b}) {
        for (const Edge& e : graph->edges) weights[{e.a, e.b}] += 0.5 * e.weight;
    }
    AdjacencyGraph out{a.n, {}};
    for (const auto& [pair, weight] : weights) out.edges.push_back({pair.first, pair.second, weight});
    return out;
}

/// Which vertices have a way to one that is not free.
std::vector<char> joined_to_fixed(const AdjacencyGraph& graph, std::size_t free) {
    const std::vector<std::uint32_t> component = components_of(graph);
    std::vector<char> holds_fixed(graph.n, 0), out(graph.n);
    for (std::size_t i = free; i < graph.n; ++i) holds_fixed[component[i]] = 1;
    for (std::size_t i = 0; i < graph.n; ++i) out[i] = holds_fixed[component[i]];
    return out;
}

}  // namespace

dense::Matrix harmonic_pull(const AdjacencyGraph& source, const AdjacencyGraph& target, std::size_t free) {
    AEROGRAM_REQUIRE(source.n == target.n && free <= source.n, source.n, target.n, free);
    const AdjacencyGraph graph = mean_of(source, target);
    const std::vector<char> joined = joined_to_fixed(graph, free);
    dense::Matrix pull(free, graph.n - free);
    if (free == 0 || pull.columns == 0) return pull;
    std::vector<double> diagonal(free, 0.0);
    std::vector<std::vector<std::pair<std::uint32_t, double>>> above(free);
    for (const Edge& e : graph.edges) {  // by a, so rows come in order
        if (!joined[e.a] || e.a >= free) continue;
        diagonal[e.a] += e.weight;
        if (e.b < free) {
            diagonal[e.b] += e.weight;
            above[e.b].emplace_back(e.a, -e.weight);
        } else {
            pull(e.a, e.b - free) += e.weight;
        }
    }
    sparse::Symmetric matrix{free, {0}, {}, {}};
    for (std::size_t j = 0; j < free; ++j) {
        for (const auto& [row, value] : above[j]) {
            matrix.rows.push_back(static_cast<int>(row));
            matrix.values.push_back(value);
        }
        matrix.rows.push_back(static_cast<int>(j));
        matrix.values.push_back(joined[j] ? diagonal[j] : 1.0);
        matrix.starts.push_back(static_cast<int>(matrix.rows.size()));
    }
    sparse::Factor factor(matrix);
    AEROGRAM_REQUIRE(factor.complete(), free);
    factor.solve(pull.values, pull.columns);
    return pull;
}

}  // namespace aerogram::planner
