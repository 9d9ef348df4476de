#include "planner/transition/rigid_gradients.hpp"

#include "geo/contract.hpp"

namespace aerogram::planner {
namespace {

constexpr int kMostRounds = 4000;
constexpr double kRest = 1e-11;

/// The three right-hand sides run side by side: every scalar is one a coordinate.
Vec3 dots(std::span<const Vec3> a, std::span<const Vec3> b) {
    Vec3 sum{};
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
}
Vec3 ratio(const Vec3& a, const Vec3& b) {
    return {b.x > 0.0 ? a.x / b.x : 0.0, b.y > 0.0 ? a.y / b.y : 0.0, b.z > 0.0 ? a.z / b.z : 0.0};
}

}  // namespace

Points laplacian_gradients(const RingGraph& graph, std::span<const Vec3> b) {
    AEROGRAM_REQUIRE(b.size() == graph.n, b.size(), graph.n);
    std::vector<double> diagonal(graph.n, 0.0);
    for (std::size_t i = 0; i < graph.n; ++i) {
        for (std::uint32_t k = graph.starts[i]; k < graph.starts[i + 1]; ++k) diagonal[i] += graph.weights[k];
        if (diagonal[i] == 0.0) diagonal[i] = 1.0;
    }
    Points x(graph.n, Vec3{}), rest(b.begin(), b.end()), way(graph.n), image(graph.n), scaled(graph.n);
    for (std::size_t i = 0; i < graph.n; ++i) way[i] = scaled[i] = rest[i] / diagonal[i];
    Vec3 energy = dots(rest, scaled);
    const Vec3 enough = kRest * kRest * dots(b, b);
    for (int round = 0; round < kMostRounds; ++round) {
        const Vec3 left = dots(rest, rest);
        if (left.x <= enough.x && left.y <= enough.y && left.z <= enough.z) break;
        for (std::size_t i = 0; i < graph.n; ++i) {
            Vec3 sum = diagonal[i] * way[i];
            for (std::uint32_t k = graph.starts[i]; k < graph.starts[i + 1]; ++k) {
                sum -= graph.weights[k] * way[graph.neighbours[k]];
            }
            image[i] = sum;
        }
        const Vec3 step = ratio(energy, dots(way, image));
        for (std::size_t i = 0; i < graph.n; ++i) {
            x[i] += step * way[i];
            rest[i] -= step * image[i];
            scaled[i] = rest[i] / diagonal[i];
        }
        const Vec3 next = dots(rest, scaled), keep = ratio(next, energy);
        energy = next;
        for (std::size_t i = 0; i < graph.n; ++i) way[i] = scaled[i] + keep * way[i];
    }
    return x;
}

}  // namespace aerogram::planner
