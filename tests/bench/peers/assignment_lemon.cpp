// Peer: LEMON's network simplex on the dense bipartite graph of an instance file (six float64 a drone); prints JSON.
// The CPU seconds are those of run() alone, without building the graph. Costs are squared distances in whole units of
// the largest cost / 2^40, so that the simplex is exact.
#include <lemon/network_simplex.h>
#include <lemon/smart_graph.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <vector>

namespace {

double cpu_s() {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    return static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
           1e-6 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

double squared(const std::array<double, 6>& from, const std::array<double, 6>& to) {
    double sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k) sum += (from[k] - to[k + 3]) * (from[k] - to[k + 3]);
    return sum;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    std::ifstream file(argv[1], std::ios::binary);
    std::vector<std::array<double, 6>> rows;
    for (std::array<double, 6> row; file.read(reinterpret_cast<char*>(row.data()), sizeof row);) rows.push_back(row);
    const int n = static_cast<int>(rows.size());
    double largest = 0.0;
    for (const auto& from : rows)
        for (const auto& to : rows) largest = std::max(largest, squared(from, to));
    const double unit = largest / 1099511627776.0;

    using Graph = lemon::SmartDigraph;
    Graph graph;
    graph.reserveNode(2 * n);
    graph.reserveArc(n * n);
    for (int k = 0; k < 2 * n; ++k) graph.addNode();
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) graph.addArc(Graph::nodeFromId(i), Graph::nodeFromId(n + j));
    const auto length_m2 = [&](const Graph::Arc& arc) {
        return squared(rows[static_cast<std::size_t>(Graph::id(graph.source(arc)))],
                       rows[static_cast<std::size_t>(Graph::id(graph.target(arc)) - n)]);
    };
    lemon::NetworkSimplex<Graph, int, std::int64_t> simplex(graph);
    {
        Graph::ArcMap<std::int64_t> cost(graph);
        for (Graph::ArcIt arc(graph); arc != lemon::INVALID; ++arc) cost[arc] = std::llround(length_m2(arc) / unit);
        Graph::NodeMap<int> supply(graph);
        for (int k = 0; k < 2 * n; ++k) supply[Graph::nodeFromId(k)] = k < n ? 1 : -1;
        simplex.costMap(cost).supplyMap(supply);
    }
    const double start_s = cpu_s();
    const bool optimal = simplex.run() == simplex.OPTIMAL;
    const double solve_s = cpu_s() - start_s;
    double cost_m2 = 0.0;
    for (Graph::ArcIt arc(graph); arc != lemon::INVALID; ++arc)
        if (simplex.flow(arc) > 0) cost_m2 += length_m2(arc);
    if (!optimal) return 1;
    std::printf("{\"n\": %d, \"cost_m2\": %.17g, \"cpu_s\": %.6f, \"lemon\": \"%s\"}\n", n, cost_m2, solve_s,
                LEMON_VERSION);
    return 0;
}
