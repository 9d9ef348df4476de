#include "planner/mesh/tetrahedra.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <string>

#include "geo/contract.hpp"
#include "planner/mesh/mesh_faults.hpp"
#include "planner/mesh/mesh_measure.hpp"
#include "planner/mesh/tetgen_input.hpp"

namespace aerogram::planner {
namespace {

/// TetGen takes vertices nearer than 1e-8 of the whole for one; ours keep ten times that.
constexpr double kDistinctShare = 1e-7;
/// Least width of the vertices beside their greatest.
constexpr double kFlatShare = 1e-9;

Error refused(const std::string& why) {
    return {ErrorCode::invalid_input, why};
}

/// Space without its size: everything in a box about one unit wide around the origin.
struct Frame {
    Vec3 center{};
    double size = 1.0;

    explicit Frame(const Points& points) {
        Vec3 low = points.front(), high = low;
        for (const Vec3& p : points) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
        center = 0.5 * low + 0.5 * high;
        const double widest = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
        if (widest > 0.0) size = std::exp2(std::ceil(std::log2(widest)));
    }
    [[nodiscard]] Points into(const Points& points) const {
        Points out;
        out.reserve(points.size());
        for (const Vec3& p : points) out.push_back((p - center) / size);
        return out;
    }
    [[nodiscard]] Vec3 out_of(const Vec3& p) const { return p * size + center; }
};

/// Two of them nearer than the tolerance, looked for along x.
bool has_doubles(const Points& framed) {
    std::vector<std::uint32_t> order(framed.size());
    std::iota(order.begin(), order.end(), 0U);
    const Vec3 direction = glm::normalize(Vec3{0.537, 0.648, 0.541});
    std::vector<double> along;
    for (const Vec3& p : framed) along.push_back(glm::dot(p, direction));
    std::sort(order.begin(), order.end(),
              [&](auto a, auto b) { return std::pair(along[a], a) < std::pair(along[b], b); });
    for (std::size_t i = 0; i < order.size(); ++i)
        for (std::size_t j = i + 1; j < order.size() && along[order[j]] - along[order[i]] <= kDistinctShare; ++j)
            if (glm::length(framed[order[j]] - framed[order[i]]) <= kDistinctShare) return true;
    return false;
}

/// Whether all lie in one plane: the farthest from a line through the farthest two, then the farthest from the plane.
bool is_flat(const Points& framed) {
    const auto farthest = [&](const auto& measure) {
        return *std::max_element(framed.begin(), framed.end(),
                                 [&](const Vec3& p, const Vec3& q) { return measure(p) < measure(q); });
    };
    const Vec3 a = framed.front();
    const Vec3 b = farthest([&](const Vec3& p) { return glm::length(p - a); });
    if (glm::length(b - a) <= kFlatShare) return true;
    const Vec3 along = glm::normalize(b - a);
    const Vec3 c = farthest([&](const Vec3& p) { return glm::length(glm::cross(p - a, along)); });
    const Vec3 normal = glm::cross(along, c - a);
    if (glm::length(normal) <= kFlatShare) return true;
    const Vec3 up = glm::normalize(normal);
    const Vec3 d = farthest([&](const Vec3& p) { return std::abs(glm::dot(p - a, up)); });
    return std::abs(glm::dot(d - a, up)) <= kFlatShare;
}

/// Why TetGen must not see these vertices; empty: it may.
std::string unfit(const Points& vertices, const Frame& frame) {
    const Points framed = frame.into(vertices);
    if (vertices.size() < 4) return "needs at least 4 vertices, here are " + std::to_string(vertices.size());
    if (is_flat(framed)) return "all vertices are in one plane";
    if (has_doubles(framed)) return "two vertices are at the same place";
    return {};
}

bool all_finite(const Points& points) {
    return std::all_of(points.begin(), points.end(),
                       [](const Vec3& p) { return is_finite(p) && glm::length(p) < 1e100; });
}

/// Only the vertices that triangles use.
TriangleMesh compact(const TriangleMesh& mesh) {
    constexpr std::uint32_t kNone = ~0U;
    std::vector<std::uint32_t> place(mesh.vertices.size(), kNone);
    TriangleMesh out;
    for (auto triangle : mesh.triangles) {
        for (std::uint32_t& corner : triangle) {
            if (place[corner] == kNone) {
                place[corner] = static_cast<std::uint32_t>(out.vertices.size());
                out.vertices.push_back(mesh.vertices[corner]);
            }
            corner = place[corner];
        }
        out.triangles.push_back(triangle);
    }
    return out;
}

/// How often the surface goes round a place: 0 outside, 1 inside a surface that faces outwards (the sum of the
/// triangles' solid angles; van Oosterom and Strackee 1983).
long winding_number(const TriangleMesh& surface, const Vec3& place) {
    double sum = 0.0;
    for (const auto& [ia, ib, ic] : surface.triangles) {
        const Vec3 a = surface.vertices[ia] - place, b = surface.vertices[ib] - place, c = surface.vertices[ic] - place;
        const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
        const double below = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
        sum += 2.0 * std::atan2(glm::dot(a, glm::cross(b, c)), below);
    }
    return std::lround(sum / (4.0 * std::numbers::pi));
}

double volume_of(const Points& v, const std::array<std::uint32_t, 4>& t) {
    return glm::dot(glm::cross(v[t[1]] - v[t[0]], v[t[2]] - v[t[0]]), v[t[3]] - v[t[0]]) / 6.0;
}

/// Drops the tetrahedra of spaces that the surface does not enclose (caves between nested shells).
void drop_caves(TetgenOutput& out, const TriangleMesh& surface) {
    std::map<std::int32_t, std::size_t> largest;  // of each space, where rounding is farthest
    for (std::size_t t = 0; t < out.tetrahedra.size(); ++t) {
        const auto [it, first] = largest.try_emplace(out.regions[t], t);
        const auto size = [&](std::size_t i) { return std::abs(volume_of(out.vertices, out.tetrahedra[i])); };
        if (!first && size(t) > size(it->second)) it->second = t;
    }
    std::map<std::int32_t, bool> inside;
    for (const auto& [region, t] : largest) {
        Vec3 middle{};
        for (const std::uint32_t corner : out.tetrahedra[t]) middle += 0.25 * out.vertices[corner];
        inside[region] = winding_number(surface, middle) != 0;
    }
    std::size_t kept = 0;
    for (std::size_t t = 0; t < out.tetrahedra.size(); ++t)
        if (inside[out.regions[t]]) out.tetrahedra[kept++] = out.tetrahedra[t];
    out.tetrahedra.resize(kept);
}

TetrahedralMesh finished(TetgenOutput&& out, const Frame& frame, const Points& originals) {
    TetrahedralMesh mesh;
    mesh.vertices = originals;
    for (std::size_t i = originals.size(); i < out.vertices.size(); ++i)
        mesh.vertices.push_back(frame.out_of(out.vertices[i]));
    mesh.tetrahedra = std::move(out.tetrahedra);
    for (auto& t : mesh.tetrahedra) {
        if (volume_of(mesh.vertices, t) < 0.0) std::swap(t[2], t[3]);
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = i + 1; j < 4; ++j) mesh.edges.push_back({std::min(t[i], t[j]), std::max(t[i], t[j])});
    }
    std::sort(mesh.edges.begin(), mesh.edges.end());
    mesh.edges.erase(std::unique(mesh.edges.begin(), mesh.edges.end()), mesh.edges.end());
    return mesh;
}

}  // namespace

Result<TetrahedralMesh> tetrahedralise(const TriangleMesh& surface, double most_volume, const Run& run) {
    AEROGRAM_REQUIRE(most_volume > 0.0 && std::isfinite(most_volume), most_volume);
    if (!all_finite(surface.vertices)) return refused("the surface has coordinates that are not finite");
    if (const std::string faults = faults_of(surface); !faults.empty()) return refused("the surface " + faults);
    const TriangleMesh used = compact(surface);
    const Frame frame(used.vertices);
    if (const std::string why = unfit(used.vertices, frame); !why.empty()) return refused("the surface: " + why);
    TetgenInput input{frame.into(used.vertices), used.triangles, most_volume / std::pow(frame.size, 3.0), false};
    auto out = run_tetgen(input, run);
    if (!out) return out.error();
    drop_caves(*out, {std::move(input.vertices), used.triangles, {}});
    return finished(std::move(*out), frame, used.vertices);
}

Result<TetrahedralMesh> tetrahedralise_around(const Points& points, const std::vector<TriangleMesh>& walls,
                                              const Run& run) {
    Points all = points;
    std::vector<std::array<std::uint32_t, 3>> facets;
    for (const TriangleMesh& wall : walls) {
        const auto offset = static_cast<std::uint32_t>(all.size());
        if (!all_finite(wall.vertices)) return refused("a wall has coordinates that are not finite");
        if (const std::string faults = faults_of(wall); !faults.empty()) return refused("a wall " + faults);
        const TriangleMesh used = compact(wall);
        all.insert(all.end(), used.vertices.begin(), used.vertices.end());
        for (const auto& [a, b, c] : used.triangles) facets.push_back({a + offset, b + offset, c + offset});
    }
    if (!all_finite(points)) return refused("a point is not finite");
    if (all.empty()) return refused("there are no points");
    if (walls.size() > 1)
        if (const std::string faults = faults_of({all, facets, {}}); !faults.empty())
            return refused("the walls together: " + faults);
    const Frame frame(all);
    if (const std::string why = unfit(all, frame); !why.empty()) return refused("points and walls: " + why);
    auto out = run_tetgen({frame.into(all), facets, 0.0, true}, run);
    if (!out) return out.error();
    return finished(std::move(*out), frame, all);
}

}  // namespace aerogram::planner
