#include "planner/mesh/mesh_faults.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <tuple>

#include "geo/contract.hpp"
#include "planner/mesh/crossings.hpp"
#include "planner/mesh/mesh_measure.hpp"

namespace aerogram::planner {
namespace {

constexpr std::size_t kMostPairs = 200'000'000;
/// Of the cube over the diagonal: less is rounding.
constexpr double kNoVolumeShare = 1e-14;

/// An edge as one triangle has it.
struct Side {
    std::uint32_t low = 0, high = 0;
    std::uint32_t triangle = 0;
    bool upwards = false;  ///< the triangle runs from low to high
};

std::vector<Side> sorted_sides(const TriangleMesh& mesh) {
    std::vector<Side> sides;
    sides.reserve(3 * mesh.triangles.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
            AEROGRAM_REQUIRE(a < mesh.vertices.size(), t, a);
            sides.push_back({std::min(a, b), std::max(a, b), t, a < b});
        }
    std::sort(sides.begin(), sides.end(), [](const Side& p, const Side& q) {
        return std::tuple(p.low, p.high, p.triangle, p.upwards) < std::tuple(q.low, q.high, q.triangle, q.upwards);
    });
    return sides;
}

/// Calls each(first, last) for the sides of every edge.
template <class Each>
void for_each_edge(const std::vector<Side>& sides, const Each& each) {
    for (auto first = sides.begin(); first != sides.end();) {
        auto last = first;
        while (last != sides.end() && last->low == first->low && last->high == first->high) ++last;
        each(first, last);
        first = last;
    }
}

std::string place(const Vec3& p) {
    char text[96];
    std::snprintf(text, sizeof text, "(%.6g, %.6g, %.6g)", p.x, p.y, p.z);
    return text;
}

/// How often, and where first.
struct Count {
    std::size_t count = 0;
    std::string where;

    void add(const TriangleMesh& mesh, const Side& side) {
        if (count++ == 0) where = "from " + place(mesh.vertices[side.low]) + " to " + place(mesh.vertices[side.high]);
    }
    [[nodiscard]] std::string said(const std::string& one, const std::string& many, const std::string& what) const {
        return std::to_string(count) + " " + (count == 1 ? one : many) + what + ", the first " + where;
    }
};

void add_fault(std::string& faults, const std::string& fault) {
    if (!faults.empty()) faults += "; ";
    faults += fault;
}

std::string faults_at_edges(const TriangleMesh& mesh) {
    Count open, crowded, against;
    for_each_edge(sorted_sides(mesh), [&](auto first, auto last) {
        const auto sides = last - first;
        if (sides == 1) open.add(mesh, *first);
        if (sides > 2) crowded.add(mesh, *first);
        if (sides == 2 && first->upwards == (first + 1)->upwards) against.add(mesh, *first);
    });
    std::string faults;
    if (open.count > 0) add_fault(faults, "is open: " + open.said("edge", "edges", " without a second triangle"));
    if (crowded.count > 0) add_fault(faults, "has " + crowded.said("edge", "edges", " of more than two triangles"));
    if (against.count > 0)
        add_fault(faults, "has " + against.said("edge", "edges", " whose triangles disagree about the outside"));
    return faults;
}

Vec3 middle(const TriangleMesh& mesh, std::uint32_t triangle) {
    const auto& [a, b, c] = mesh.triangles[triangle];
    return (mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3.0;
}

std::string fault_of_crossings(const TriangleMesh& mesh) {
    const Crossings found = crossings_of(mesh, kMostPairs);
    if (found.gave_up) return "has too many triangles at one place to look whether they pass through each other";
    if (found.pairs == 0) return {};
    const Count said{found.pairs, "near " + place(middle(mesh, found.first.first))};
    return "passes through itself: " + said.said("pair", "pairs", " of triangles");
}

std::string fault_of_flat_triangles(const TriangleMesh& mesh) {
    Count flat;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        if (area_of(mesh, t) > 0.0) continue;
        if (flat.count++ == 0) flat.where = "at " + place(middle(mesh, t));
    }
    return flat.count == 0 ? "" : "has " + flat.said("triangle", "triangles", " without area");
}

/// Turns whole pieces so that neighbours agree; piece[t] is t's piece. @returns the number of pieces.
std::size_t agree(TriangleMesh& mesh, std::vector<std::uint32_t>& piece) {
    struct Link {
        std::uint32_t triangle = 0, other = 0;
        bool same = false;
    };
    std::vector<Link> links;
    for_each_edge(sorted_sides(mesh), [&](auto first, auto last) {
        if (last - first != 2) return;
        const bool same = first->upwards != (first + 1)->upwards;
        links.push_back({first->triangle, (first + 1)->triangle, same});
        links.push_back({(first + 1)->triangle, first->triangle, same});
    });
    std::stable_sort(links.begin(), links.end(), [](const Link& p, const Link& q) { return p.triangle < q.triangle; });
    constexpr std::uint32_t kNone = ~0U;
    piece.assign(mesh.triangles.size(), kNone);
    std::vector<bool> turned(mesh.triangles.size(), false);
    std::uint32_t pieces = 0;
    std::vector<std::uint32_t> next;
    for (std::uint32_t seed = 0; seed < mesh.triangles.size(); ++seed) {
        if (piece[seed] != kNone) continue;
        piece[seed] = pieces;
        next.push_back(seed);
        while (!next.empty()) {
            const std::uint32_t t = next.back();
            next.pop_back();
            auto link = std::lower_bound(links.begin(), links.end(), t,
                                         [](const Link& l, std::uint32_t of) { return l.triangle < of; });
            for (; link != links.end() && link->triangle == t; ++link) {
                if (piece[link->other] != kNone) continue;
                piece[link->other] = pieces;
                turned[link->other] = turned[t] == link->same;
                next.push_back(link->other);
            }
        }
        ++pieces;
    }
    for (std::size_t t = 0; t < turned.size(); ++t)
        if (turned[t]) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
    return pieces;
}

}  // namespace

std::string faults_of(const TriangleMesh& mesh) {
    if (mesh.triangles.empty()) return "has no triangle";
    for (const Vec3& v : mesh.vertices) AEROGRAM_REQUIRE(is_finite(v));
    std::string faults = faults_at_edges(mesh);
    for (const std::string& fault : {fault_of_flat_triangles(mesh), fault_of_crossings(mesh)})
        if (!fault.empty()) add_fault(faults, fault);
    if (faults.empty() && std::abs(enclosed_volume(mesh)) <= kNoVolumeShare * std::pow(diagonal_of(mesh), 3.0))
        faults = "encloses nothing: its volume is 0";
    return faults;
}

TriangleMesh turned_outwards(TriangleMesh mesh) {
    std::vector<std::uint32_t> piece;
    const std::size_t pieces = agree(mesh, piece);
    std::vector<double> volume(pieces, 0.0);
    const Vec3 origin = mesh.vertices.empty() ? Vec3{} : mesh.vertices.front();
    for (std::uint32_t t = 0; t < piece.size(); ++t) volume[piece[t]] += cone_volume(mesh, t, origin);
    for (std::size_t t = 0; t < piece.size(); ++t)
        if (volume[piece[t]] < 0.0) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
    return mesh;
}

}  // namespace aerogram::planner
