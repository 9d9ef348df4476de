#include <algorithm>
#include <numeric>

#include "planner/mesh/mesh_measure.hpp"
#include "planner/mesh/scene.hpp"

namespace aerogram::planner {
namespace {

/// Nearer than this share of the whole is the same place: single precision writes a place no better.
constexpr double kSamePlaceShare = 1e-6;
/// Of the square over the diagonal.
constexpr double kNoAreaShare = 1e-14;

/// For each vertex the lowest one at its place, found along a direction that is no mesh's own.
std::vector<std::uint32_t> first_at_place(const Points& points, double tolerance) {
    const Vec3 direction = glm::normalize(Vec3{0.537, 0.648, 0.541});
    std::vector<double> along;
    along.reserve(points.size());
    for (const Vec3& p : points) along.push_back(glm::dot(p, direction));
    std::vector<std::uint32_t> order(points.size()), first(points.size());
    std::iota(order.begin(), order.end(), 0U);
    std::iota(first.begin(), first.end(), 0U);
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return std::pair(along[a], a) < std::pair(along[b], b); });
    const auto root = [&](std::uint32_t i) {
        while (first[i] != i) i = first[i] = first[first[i]];
        return i;
    };
    for (std::size_t k = 0; k < order.size(); ++k) {
        const std::uint32_t i = order[k];
        for (std::size_t j = k + 1; j < order.size() && along[order[j]] - along[i] <= tolerance; ++j) {
            // One at exactly this place has the others as neighbours too.
            const Vec3 apart = points[order[j]] - points[i];
            if (glm::dot(apart, apart) > tolerance * tolerance) continue;
            const std::uint32_t one = root(order[j]), other = root(i);
            first[std::max(one, other)] = std::min(one, other);
            if (apart == Vec3{}) break;
        }
    }
    for (std::uint32_t i = 0; i < first.size(); ++i) first[i] = root(i);
    return first;
}

}  // namespace

TriangleMesh welded(const TriangleMesh& rest, const TriangleMesh& then) {
    const double diagonal = diagonal_of(rest);
    const std::vector<std::uint32_t> first = first_at_place(rest.vertices, kSamePlaceShare * diagonal);
    constexpr std::uint32_t kNone = ~0U;
    std::vector<std::uint32_t> place(rest.vertices.size(), kNone);
    TriangleMesh out;
    for (std::uint32_t t = 0; t < rest.triangles.size(); ++t) {
        std::array<std::uint32_t, 3> corners = rest.triangles[t];
        for (std::uint32_t& corner : corners) corner = first[corner];
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
        if (area_of(rest, t) <= kNoAreaShare * diagonal * diagonal) continue;
        for (std::uint32_t& corner : corners) {
            if (place[corner] == kNone) {
                place[corner] = static_cast<std::uint32_t>(out.vertices.size());
                out.vertices.push_back(then.vertices[corner]);
                if (!then.colors.empty()) out.colors.push_back(then.colors[corner]);
            }
            corner = place[corner];
        }
        out.triangles.push_back(corners);
    }
    return out;
}

}  // namespace aerogram::planner
