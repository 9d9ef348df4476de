#include "planner/mesh/nearest_on_mesh.hpp"

#include <algorithm>
#include <numeric>

#include "geo/contract.hpp"
#include "planner/mesh/surface_walk.hpp"

namespace aerogram::planner {
namespace {

constexpr std::uint32_t kLeaf = 4;

/// The squared distance from p to the box.
double squared_to(const Vec3& p, const Vec3& low, const Vec3& high) {
    const Vec3 d = glm::max(glm::max(low - p, p - high), Vec3(0.0));
    return glm::dot(d, d);
}

}  // namespace

Vec3 position_of(const MeshPlace& place, const TriangleMesh& mesh) {
    const auto& [a, b, c] = mesh.triangles[place.triangle];
    return mesh.vertices[a] * place.shares.x + mesh.vertices[b] * place.shares.y + mesh.vertices[c] * place.shares.z;
}

Rgb color_of(const MeshPlace& place, const TriangleMesh& mesh) {
    const auto& corners = mesh.triangles[place.triangle];
    Rgb out;
    for (int k = 0; k < 3; ++k) {
        const Rgb& corner = mesh.colors[corners[static_cast<std::size_t>(k)]];
        out.r += corner.r * place.shares[k];
        out.g += corner.g * place.shares[k];
        out.b += corner.b * place.shares[k];
    }
    return clamped(out);
}

NearestOnMesh::NearestOnMesh(const TriangleMesh& mesh) : mesh_(mesh), order_(mesh.triangles.size()) {
    AEROGRAM_REQUIRE(!mesh.triangles.empty());
    std::iota(order_.begin(), order_.end(), 0U);
    Points centres;
    centres.reserve(mesh.triangles.size());
    for (const auto& [a, b, c] : mesh.triangles)
        centres.push_back((mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3.0);
    build(0, static_cast<std::uint32_t>(order_.size()), centres);
}

std::uint32_t NearestOnMesh::build(std::uint32_t first, std::uint32_t count, const Points& centres) {
    const auto number = static_cast<std::uint32_t>(nodes_.size());
    Node node{Vec3(1e300), Vec3(-1e300), first, count, 0};
    Vec3 low = node.low, high = node.high;  // of the centres
    for (std::uint32_t k = first; k < first + count; ++k) {
        for (const std::uint32_t v : mesh_.triangles[order_[k]]) {
            node.low = glm::min(node.low, mesh_.vertices[v]);
            node.high = glm::max(node.high, mesh_.vertices[v]);
        }
        low = glm::min(low, centres[order_[k]]);
        high = glm::max(high, centres[order_[k]]);
    }
    nodes_.push_back(node);
    if (count <= kLeaf) return number;
    const Vec3 size = high - low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto begin = order_.begin() + static_cast<std::ptrdiff_t>(first);
    std::nth_element(begin, begin + count / 2, begin + count, [&](std::uint32_t a, std::uint32_t b) {
        return centres[a][axis] != centres[b][axis] ? centres[a][axis] < centres[b][axis] : a < b;
    });
    build(first, count / 2, centres);
    const std::uint32_t second = build(first + count / 2, count - count / 2, centres);
    nodes_[number].count = 0;
    nodes_[number].second = second;
    return number;
}

void NearestOnMesh::seek(std::uint32_t number, const Vec3& p, double& squared, MeshPlace& best) const {
    const Node& node = nodes_[number];
    if (node.count > 0) {
        for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
            const auto& [a, b, c] = mesh_.triangles[order_[k]];
            const MeshPlace place{order_[k],
                                  nearest_shares(p, mesh_.vertices[a], mesh_.vertices[b], mesh_.vertices[c])};
            const Vec3 d = position_of(place, mesh_) - p;
            const double now = glm::dot(d, d);
            if (now > squared || (now == squared && place.triangle >= best.triangle)) continue;
            squared = now;
            best = place;
        }
        return;
    }
    const std::uint32_t children[2] = {number + 1, node.second};
    double distance[2];
    for (int k = 0; k < 2; ++k) distance[k] = squared_to(p, nodes_[children[k]].low, nodes_[children[k]].high);
    const int nearer = distance[0] <= distance[1] ? 0 : 1;
    for (const int k : {nearer, 1 - nearer}) {
        if (distance[k] <= squared) seek(children[k], p, squared, best);
    }
}

MeshPlace NearestOnMesh::nearest(const Vec3& p) const {
    double squared = 1e300;
    MeshPlace best{0xFFFFFFFFU, {}};
    seek(0, p, squared, best);
    return best;
}

}  // namespace aerogram::planner
