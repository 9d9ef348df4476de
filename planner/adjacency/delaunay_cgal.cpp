// CGAL's own checks stay on in every build: without them one bad coordinate gives a plausible wrong answer.
#undef NDEBUG
#undef CGAL_NDEBUG
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <limits>
#include <type_traits>

#include "geo/contract.hpp"
#include "planner/adjacency/delaunay.hpp"

namespace aerogram::planner {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Plane = CGAL::Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>>>;
using Space = CGAL::Delaunay_triangulation_3<
    Kernel, CGAL::Triangulation_data_structure_3<CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel>,
                                                 CGAL::Delaunay_triangulation_cell_base_3<Kernel>>>;

Kernel::Point_2 cgal_point(const Vec2& p) {
    return {p.x, p.y};
}
Kernel::Point_3 cgal_point(const Vec3& p) {
    return {p.x, p.y, p.z};
}

/// Inserts in index order, so that nothing depends on CGAL's random shuffling.
template <class Triangulation, class Point>
Triangulation triangulated(std::span<const Point> points_m, Delaunay& result) {
    for (const Point& p : points_m)
        AEROGRAM_REQUIRE(glm::dot(p, p) < std::numeric_limits<double>::infinity(), points_m.size());
    Triangulation t;
    typename Triangulation::Vertex_handle last{};
    for (std::size_t i = 0; i < points_m.size(); ++i) {
        const std::size_t before = t.number_of_vertices();
        if constexpr (std::is_same_v<Triangulation, Plane>)
            last = t.insert(cgal_point(points_m[i]),
                            last == nullptr ? typename Triangulation::Face_handle{} : last->face());
        else
            last = t.insert(cgal_point(points_m[i]), last);
        if (t.number_of_vertices() > before)
            last->info() = static_cast<std::uint32_t>(i);
        else
            result.doubles.emplace_back(last->info(), static_cast<std::uint32_t>(i));
    }
    return t;
}

void add_edge(Delaunay& result, std::uint32_t a, std::uint32_t b, std::size_t ring_begin) {
    result.edges.push_back({std::min(a, b), std::max(a, b), ring_begin, result.rings.size()});
}

/// Runs a CGAL computation; what CGAL throws is a bug of ours.
template <class Compute>
Delaunay guarded(const Compute& compute) {
    try {
        return compute();
    } catch (const CGAL::Failure_exception& e) {
        throw ContractViolation(e.what());
    }
}

}  // namespace

Delaunay delaunay_in_plane(std::span<const Vec2> points_m) {
    return guarded([&] {
        Delaunay result;
        const auto t = triangulated<Plane>(points_m, result);
        AEROGRAM_REQUIRE(t.dimension() == 2, t.dimension(), points_m.size());
        for (auto edge = t.finite_edges_begin(); edge != t.finite_edges_end(); ++edge) {
            const auto [face, side] = *edge;
            const std::size_t ring_begin = result.rings.size();
            for (const auto& opposite : {face->vertex(side), t.mirror_vertex(face, side)})
                if (!t.is_infinite(opposite)) result.rings.push_back(opposite->info());
            add_edge(result, face->vertex(Plane::cw(side))->info(), face->vertex(Plane::ccw(side))->info(), ring_begin);
        }
        return result;
    });
}

Delaunay delaunay_in_space(std::span<const Vec3> points_m) {
    return guarded([&] {
        Delaunay result;
        const auto t = triangulated<Space>(points_m, result);
        AEROGRAM_REQUIRE(t.dimension() == 3, t.dimension(), points_m.size());
        for (auto edge = t.finite_edges_begin(); edge != t.finite_edges_end(); ++edge) {
            const auto a = edge->first->vertex(edge->second), b = edge->first->vertex(edge->third);
            const std::size_t ring_begin = result.rings.size();
            const auto start = t.incident_facets(*edge);
            auto facet = start;
            do {
                for (int k = 0; k < 4; ++k) {
                    const auto v = facet->first->vertex(k);
                    if (k != facet->second && v != a && v != b && !t.is_infinite(v)) result.rings.push_back(v->info());
                }
            } while (++facet != start);
            add_edge(result, a->info(), b->info(), ring_begin);
        }
        return result;
    });
}

}  // namespace aerogram::planner
