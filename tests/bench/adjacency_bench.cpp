// The default neighbour graph of a formation. Each run checks the edge count that the formation must have.
#include <benchmark/benchmark.h>

#include "planner/adjacency/adjacency.hpp"
#include "tests/unit/planner/adjacency/formations.hpp"

namespace aerogram::planner {
namespace {

using namespace testing;

void measure(benchmark::State& state, const Points& points_m, std::size_t least_edges, std::size_t most_edges) {
    AdjacencyGraph graph;
    for (auto _ : state) {
        graph = delaunay_adjacency(points_m);
        benchmark::DoNotOptimize(graph.edges.data());
    }
    if (!is_connected(graph)) state.SkipWithError("the graph is not connected");
    if (graph.edges.size() < least_edges || graph.edges.size() > most_edges)
        state.SkipWithError("wrong number of edges");
    state.counters["edges"] = static_cast<double>(graph.edges.size());
}

/// A ball's surface has 3n - 6 edges (Euler).
void adjacency_of_sphere(benchmark::State& state) {
    const auto n = static_cast<std::size_t>(state.range(0));
    measure(state, sphere(n, 10.0), 3 * n - 6, 3 * n - 6);
}
/// A tilted sheet of ten columns has n - 10 edges up and 9n/10 across.
void adjacency_of_tilted_sheet(benchmark::State& state) {
    const auto n = static_cast<std::size_t>(state.range(0));
    measure(state, Motion{{0.5, 0.2, 0.1}, {5, 5, 40}}(grid(10, n / 10, 2.2)), n - 10 + 9 * n / 10,
            n - 10 + 9 * n / 10);
}
/// Random points in a box have at most 8 n edges in practice, at least a spanning tree.
void adjacency_of_random_points(benchmark::State& state) {
    const auto n = static_cast<std::size_t>(state.range(0));
    measure(state, random_points(n, 1), n - 1, 8 * n);
}

BENCHMARK(adjacency_of_sphere)->Arg(10)->Arg(60)->Arg(300)->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK(adjacency_of_tilted_sheet)->Arg(10)->Arg(60)->Arg(300)->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK(adjacency_of_random_points)->Arg(10)->Arg(60)->Arg(300)->Arg(1000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace aerogram::planner
