// CGAL's own checks stay on in every build: without them one bad coordinate gives a plausible wrong answer.
#undef NDEBUG
#undef CGAL_NDEBUG
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <array>
#include <vector>

#include "geo/contract.hpp"
#include "planner/mesh/crossings.hpp"

namespace aerogram::planner {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;
using Corners = std::array<std::uint32_t, 3>;

struct TooManyPairs {};

class Soup {
  public:
    explicit Soup(const TriangleMesh& mesh) : mesh_(mesh) {
        for (const Vec3& v : mesh.vertices) points_.emplace_back(v.x, v.y, v.z);
    }

    [[nodiscard]] std::vector<Box> boxes() const {
        std::vector<Box> all;
        for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
            const Corners& c = mesh_.triangles[t];
            if (flat(c)) continue;
            all.emplace_back(triangle(c).bbox(), t);
        }
        return all;
    }

    /// More in common than the corners or the edge that they share.
    [[nodiscard]] bool pass_through(std::uint32_t first, std::uint32_t second) const {
        Corners a = mesh_.triangles[first], b = mesh_.triangles[second];
        const std::size_t shared = shared_in_front(a, b);
        if (shared == 3) return true;
        if (shared == 2) {
            const Point &p = points_[a[0]], &q = points_[a[1]], &r = points_[a[2]], &s = points_[b[2]];
            return CGAL::coplanar(p, q, r, s) && CGAL::coplanar_orientation(p, q, r, s) == CGAL::POSITIVE;
        }
        if (shared == 1)
            return CGAL::do_intersect(Kernel::Segment_3(points_[a[1]], points_[a[2]]), triangle(b)) ||
                   CGAL::do_intersect(Kernel::Segment_3(points_[b[1]], points_[b[2]]), triangle(a));
        return CGAL::do_intersect(triangle(a), triangle(b));
    }

  private:
    [[nodiscard]] bool flat(const Corners& c) const {
        return CGAL::collinear(points_[c[0]], points_[c[1]], points_[c[2]]);
    }
    [[nodiscard]] Kernel::Triangle_3 triangle(const Corners& c) const {
        return {points_[c[0]], points_[c[1]], points_[c[2]]};
    }
    /// Brings the corners that both have to the front of both, in the same order.
    static std::size_t shared_in_front(Corners& a, Corners& b) {
        std::size_t shared = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const auto* const same = std::find(b.begin() + shared, b.end(), a[i]);
            if (same == b.end()) continue;
            std::swap(a[i], a[shared]);
            std::swap(b[static_cast<std::size_t>(same - b.begin())], b[shared]);
            ++shared;
        }
        return shared;
    }

    const TriangleMesh& mesh_;
    std::vector<Point> points_;
};

}  // namespace

Crossings crossings_of(const TriangleMesh& mesh, std::size_t most_pairs) {
    try {
        const Soup soup(mesh);
        std::vector<Box> boxes = soup.boxes();
        Crossings found;
        std::size_t pairs = 0;
        CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& p, const Box& q) {
            if (++pairs > most_pairs) throw TooManyPairs{};
            const std::uint32_t first = std::min(p.info(), q.info()), second = std::max(p.info(), q.info());
            if (!soup.pass_through(first, second)) return;
            const std::pair<std::uint32_t, std::uint32_t> place{first, second};
            if (found.pairs++ == 0 || place < found.first) found.first = place;
        });
        return found;
    } catch (const TooManyPairs&) {
        return {0, {}, true};
    } catch (const CGAL::Failure_exception& e) {
        throw ContractViolation(e.what());
    }
}

}  // namespace aerogram::planner
