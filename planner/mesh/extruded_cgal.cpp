// CGAL's own checks stay on in every build: without them one bad coordinate gives a plausible wrong answer.
#undef NDEBUG
#undef CGAL_NDEBUG
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_face_base_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "geo/contract.hpp"
#include "planner/mesh/solids.hpp"

namespace aerogram::planner {
namespace {

constexpr std::uint32_t kUnnumbered = 0xFFFFFFFFU;

struct FaceInfo {
    bool seen = false, inside = false;
};
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertices = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using Faces =
    CGAL::Constrained_triangulation_face_base_2<Kernel, CGAL::Triangulation_face_base_with_info_2<FaceInfo, Kernel>>;
// Contours that cross get a vertex there, rounded to doubles; which side a point is on stays exact.
using Flat = CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertices, Faces>,
                                                        CGAL::Exact_predicates_tag>;

/// The edges of a region by height, so that the winding number of a place is found without looking at all of them.
class Windings {
  public:
    explicit Windings(const Region& region) {
        for (const Contour& contour : region.contours) {
            for (std::size_t i = 0; i < contour.size(); ++i) {
                const Vec2 &a = contour[i], &b = contour[(i + 1) % contour.size()];
                if (a.y != b.y) edges_.push_back({a, b});
            }
        }
        const Bounds box = bounds_of(region);
        low_ = box.low.y;
        slabs_.resize(std::clamp<std::size_t>(edges_.size() / 4, 1, 4096));
        height_ = std::max(box.size().y / static_cast<double>(slabs_.size()), 1e-300);
        for (std::uint32_t e = 0; e < edges_.size(); ++e) {
            const auto [low, high] = std::minmax(edges_[e][0].y, edges_[e][1].y);
            for (std::size_t s = slab(low); s <= slab(high); ++s) slabs_[s].push_back(e);
        }
    }

    [[nodiscard]] int around(const Vec2& p) const {
        int winding = 0;
        for (const std::uint32_t e : slabs_[slab(p.y)]) {
            const auto& [a, b] = edges_[e];
            if ((a.y <= p.y) == (b.y <= p.y)) continue;
            const double x = a.x + (b.x - a.x) * ((p.y - a.y) / (b.y - a.y));
            if (x > p.x) winding += b.y > a.y ? 1 : -1;
        }
        return winding;
    }

  private:
    [[nodiscard]] std::size_t slab(double y) const {
        const double last = static_cast<double>(slabs_.size() - 1);
        return static_cast<std::size_t>(std::clamp((y - low_) / height_, 0.0, last));
    }

    std::vector<std::array<Vec2, 2>> edges_;
    std::vector<std::vector<std::uint32_t>> slabs_;
    double low_ = 0.0, height_ = 1.0;
};

Vec2 at(const Flat::Vertex_handle& v) {
    return {v->point().x(), v->point().y()};
}

double area_of(const Flat::Face_handle& f) {
    const Vec2 a = at(f->vertex(0)), u = at(f->vertex(1)) - a, v = at(f->vertex(2)) - a;
    return 0.5 * (u.x * v.y - u.y * v.x);
}

/// All faces that no contour parts from `start`; what one of them is they all are.
std::vector<Flat::Face_handle> patch_of(const Flat& flat, const Flat::Face_handle& start) {
    std::vector<Flat::Face_handle> patch{start};
    start->info().seen = true;
    for (std::size_t k = 0; k < patch.size(); ++k) {
        for (int side = 0; side < 3; ++side) {
            const Flat::Face_handle next = patch[k]->neighbor(side);
            if (flat.is_infinite(next) || next->info().seen || patch[k]->is_constrained(side)) continue;
            next->info().seen = true;
            patch.push_back(next);
        }
    }
    return patch;
}

Flat triangulated(const Region& region) {
    Flat flat;
    for (const Contour& contour : region.contours) {
        std::vector<Flat::Vertex_handle> corners;
        for (const Vec2& p : contour) {
            AEROGRAM_REQUIRE(std::isfinite(p.x) && std::isfinite(p.y), p.x, p.y);
            const Flat::Face_handle near = corners.empty() ? Flat::Face_handle{} : corners.back()->face();
            corners.push_back(flat.insert({p.x, p.y}, near));
        }
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const auto a = corners[i], b = corners[(i + 1) % corners.size()];
            if (a != b) flat.insert_constraint(a, b);
        }
    }
    AEROGRAM_REQUIRE(flat.dimension() == 2, flat.dimension());
    const Windings windings(region);
    for (const auto& face : flat.finite_face_handles()) {
        if (face->info().seen) continue;
        const auto patch = patch_of(flat, face);
        const auto widest = *std::max_element(patch.begin(), patch.end(),
                                              [](const auto& a, const auto& b) { return area_of(a) < area_of(b); });
        const Vec2 centre = (at(widest->vertex(0)) + at(widest->vertex(1)) + at(widest->vertex(2))) / 3.0;
        const bool inside = windings.around(centre) != 0;
        for (const auto& f : patch) f->info().inside = inside;
    }
    return flat;
}

TriangleMesh lifted(const Flat& flat, double depth) {
    TriangleMesh mesh;
    std::uint32_t count = 0;
    for (const auto& v : flat.finite_vertex_handles()) v->info() = kUnnumbered;
    const auto number = [&](const Flat::Vertex_handle& v) {
        if (v->info() == kUnnumbered) {
            v->info() = count++;
            mesh.vertices.emplace_back(v->point().x(), -0.5 * depth, v->point().y());
            mesh.vertices.emplace_back(v->point().x(), 0.5 * depth, v->point().y());
        }
        return 2 * v->info();  // the front's; the back's is the next
    };
    for (const auto& face : flat.finite_face_handles()) {
        if (!face->info().inside) continue;
        const std::uint32_t v[3] = {number(face->vertex(0)), number(face->vertex(1)), number(face->vertex(2))};
        mesh.triangles.push_back({v[0], v[1], v[2]});
        mesh.triangles.push_back({v[2] + 1, v[1] + 1, v[0] + 1});
        for (int side = 0; side < 3; ++side) {
            const Flat::Face_handle next = face->neighbor(side);
            if (!flat.is_infinite(next) && next->info().inside) continue;
            const std::uint32_t a = v[Flat::ccw(side)], b = v[Flat::cw(side)];
            mesh.triangles.push_back({b, a, a + 1});
            mesh.triangles.push_back({b, a + 1, b + 1});
        }
    }
    AEROGRAM_REQUIRE(!mesh.triangles.empty(), flat.number_of_vertices());
    return mesh;
}

}  // namespace

TriangleMesh extruded(const Region& region, double depth) {
    AEROGRAM_REQUIRE(depth > 0.0 && !region.contours.empty(), depth, region.contours.size());
    try {
        return lifted(triangulated(region), depth);
    } catch (const CGAL::Failure_exception& e) {
        throw ContractViolation(e.what());
    }
}

}  // namespace aerogram::planner
