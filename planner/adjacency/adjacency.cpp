#include "planner/adjacency/adjacency.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

#include "planner/adjacency/delaunay.hpp"
#include "planner/adjacency/dual.hpp"
#include "planner/adjacency/edge_weight.hpp"
#include "planner/adjacency/formation_shape.hpp"

namespace aerogram::planner {
namespace {

/// Neighbours whose common Voronoi edge or face is narrower than this share of their distance only tie with others:
/// points rounded to 1 mm a metre or more apart stay within it.
constexpr double kTieShare = 2e-3;
/// Spheres beyond this many formation radii from an edge do not make neighbours: on a hull that is flat up to rounding
/// they would join its far ends.
constexpr double kReachRadii = 10.0;
/// A solid formation thinner than this many spacings is nearly flat: a few layers.
constexpr double kNearlyFlatSpacings = 2.0;
/// In a nearly flat formation edges longer than this many local spacings are slivers: neighbours in an even layer are
/// at most √2 spacings apart, or √5 over a place left empty.
constexpr double kLongEdgeSpacings = 3.0;

struct Candidate {
    std::uint32_t a = 0, b = 0;
    double length_m = 0.0;
    bool kept = true;
};

/// The end of the chain of "same set as" links.
std::uint32_t set_of(std::vector<std::uint32_t>& parent, std::uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
}

std::vector<Candidate> along_row(std::span<const Vec3> places_m, const FormationShape& shape) {
    std::vector<double> along_m(places_m.size());
    for (std::size_t i = 0; i < places_m.size(); ++i)
        along_m[i] = glm::dot(places_m[i] - shape.center_m, shape.axes[0]);
    std::vector<std::uint32_t> order(places_m.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return std::pair(along_m[a], a) < std::pair(along_m[b], b); });
    std::vector<Candidate> chain;
    for (std::size_t k = 1; k < order.size(); ++k)
        chain.push_back({std::min(order[k - 1], order[k]), std::max(order[k - 1], order[k])});
    return chain;
}

/// The triangulation's edges, those that merely tie marked as not kept.
template <class Point, class Width>
std::vector<Candidate> decided(const Delaunay& delaunay, const std::vector<Point>& at_m, const Width& width_m,
                               double reach_m) {
    std::vector<Candidate> edges;
    std::vector<Point> ring_m;
    for (const DelaunayEdge& e : delaunay.edges) {
        ring_m.clear();
        for (const std::uint32_t r : delaunay.ring(e)) ring_m.push_back(at_m[r]);
        const double least_m = kTieShare * glm::length(at_m[e.b] - at_m[e.a]);
        edges.push_back({e.a, e.b, 0.0, width_m(at_m[e.a], at_m[e.b], ring_m, reach_m) > least_m});
    }
    for (const auto& [vertex, twin] : delaunay.doubles)
        edges.push_back({std::min(vertex, twin), std::max(vertex, twin)});
    return edges;
}

std::vector<Candidate> in_plane(std::span<const Vec3> places_m, const FormationShape& shape) {
    std::vector<Vec2> flat_m;
    for (const Vec3& p : places_m)
        flat_m.emplace_back(glm::dot(p - shape.center_m, shape.axes[0]), glm::dot(p - shape.center_m, shape.axes[1]));
    return decided(delaunay_in_plane(flat_m), flat_m, dual_length_m, kReachRadii * shape.radius_m);
}

std::vector<Candidate> in_space(std::span<const Vec3> places_m, const FormationShape& shape) {
    std::vector<Vec3> centred_m;
    for (const Vec3& p : places_m) centred_m.push_back(p - shape.center_m);
    return decided(delaunay_in_space(centred_m), centred_m, dual_width_m, kReachRadii * shape.radius_m);
}

/// Marks edges that are long against the second shortest edge of both their ends: in a stroke everyone has two
/// neighbours.
void drop_long(std::vector<Candidate>& edges, std::size_t n) {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    std::vector<std::pair<double, double>> shortest_m(n, {kNone, kNone});
    for (const Candidate& e : edges)
        for (const std::uint32_t i : {e.a, e.b}) {
            auto& [first, second] = shortest_m[i];
            if (e.kept && e.length_m < second) second = std::max(first, e.length_m);
            if (e.kept && e.length_m < first) first = e.length_m;
        }
    for (Candidate& e : edges) {
        const double spacing_m = std::max(shortest_m[e.a].second, shortest_m[e.b].second);
        if (e.length_m > kLongEdgeSpacings * spacing_m) e.kept = false;
    }
}

/// Takes dropped edges back, shortest first, where they join parts that nothing else joins.
void reconnect(std::vector<Candidate>& edges, std::size_t n) {
    std::vector<std::uint32_t> parent(n);
    std::iota(parent.begin(), parent.end(), 0U);
    std::sort(edges.begin(), edges.end(), [](const Candidate& p, const Candidate& q) {
        return std::tuple(!p.kept, p.length_m, p.a, p.b) < std::tuple(!q.kept, q.length_m, q.a, q.b);
    });
    for (Candidate& e : edges) {
        const std::uint32_t first = set_of(parent, e.a), second = set_of(parent, e.b);
        if (first != second) e.kept = true;
        parent[std::max(first, second)] = std::min(first, second);
    }
}

std::vector<Candidate> neighbours(std::span<const Vec3> places_m) {
    const FormationShape shape = shape_of(places_m);
    if (shape.dimension == 0) return {};
    std::vector<Candidate> edges = shape.dimension == 1   ? along_row(places_m, shape)
                                   : shape.dimension == 2 ? in_plane(places_m, shape)
                                                          : in_space(places_m, shape);
    for (Candidate& e : edges) e.length_m = glm::length(places_m[e.b] - places_m[e.a]);
    if (shape.dimension == 3 && shape.thickness_m <= kNearlyFlatSpacings * shape.spacing_m)
        drop_long(edges, places_m.size());
    reconnect(edges, places_m.size());
    return edges;
}

}  // namespace

AdjacencyGraph delaunay_adjacency(std::span<const Vec3> points_m) {
    AEROGRAM_REQUIRE(!points_m.empty());
    for (std::size_t i = 0; i < points_m.size(); ++i) AEROGRAM_REQUIRE(is_finite(points_m[i]), i);
    const std::vector<std::uint32_t> first = same_place(points_m);
    std::vector<std::uint32_t> places;
    Points places_m;
    for (std::uint32_t i = 0; i < first.size(); ++i)
        if (first[i] == i) {
            places.push_back(i);
            places_m.push_back(points_m[i]);
        }
    AdjacencyGraph graph{points_m.size(), {}};
    for (const Candidate& e : neighbours(places_m))
        if (e.kept) graph.edges.push_back({places[e.a], places[e.b], 1.0 / e.length_m});
    const double strongest = strongest_weight(graph);
    for (std::uint32_t i = 0; i < first.size(); ++i)
        for (std::uint32_t j = i + 1; j < first.size() && places.size() < first.size(); ++j)
            if (first[i] == first[j]) graph.edges.push_back({i, j, strongest});
    std::sort(graph.edges.begin(), graph.edges.end(),
              [](const Edge& p, const Edge& q) { return std::pair(p.a, p.b) < std::pair(q.a, q.b); });
    return graph;
}

}  // namespace aerogram::planner
