#include "planner/mesh/volume_walk.hpp"

#include <algorithm>
#include <utility>

namespace aerogram::planner {
namespace {

constexpr int kStepsAtMost = 100;

struct Face {
    std::array<std::uint32_t, 3> vertices;  ///< ascending
    std::uint32_t tetrahedron, opposite;
    bool operator<(const Face& o) const {
        return vertices != o.vertices ? vertices < o.vertices : tetrahedron < o.tetrahedron;
    }
};

double volume6(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return glm::dot(glm::cross(b - a, c - a), d - a);
}

/// Shares of the corners at p, their sum 1; negative beyond the face opposite to a corner.
std::array<double, 4> shares_at(const std::array<Vec3, 4>& v, const Vec3& p) {
    const double whole = volume6(v[0], v[1], v[2], v[3]);
    if (whole == 0.0) return {1.0, 0.0, 0.0, 0.0};
    const double a = volume6(p, v[1], v[2], v[3]) / whole, b = volume6(v[0], p, v[2], v[3]) / whole;
    const double c = volume6(v[0], v[1], p, v[3]) / whole;
    return {a, b, c, 1.0 - a - b - c};
}

}  // namespace

VolumeWalk::VolumeWalk(const TetrahedralMesh& mesh) : mesh_(mesh) {
    std::vector<Face> faces;
    faces.reserve(4 * mesh.tetrahedra.size());
    for (std::uint32_t t = 0; t < mesh.tetrahedra.size(); ++t) {
        const auto& v = mesh.tetrahedra[t];
        for (std::uint32_t k = 0; k < 4; ++k) {
            Face face{{v[(k + 1) % 4], v[(k + 2) % 4], v[(k + 3) % 4]}, t, k};
            std::sort(face.vertices.begin(), face.vertices.end());
            faces.push_back(face);
        }
    }
    std::sort(faces.begin(), faces.end());
    next_.assign(mesh.tetrahedra.size(), {kOutside, kOutside, kOutside, kOutside});
    for (std::size_t k = 0; k + 1 < faces.size(); ++k) {
        if (faces[k].vertices != faces[k + 1].vertices) continue;
        next_[faces[k].tetrahedron][faces[k].opposite] = faces[k + 1].tetrahedron;
        next_[faces[k + 1].tetrahedron][faces[k + 1].opposite] = faces[k].tetrahedron;
    }
}

VolumePlace VolumeWalk::towards(const VolumePlace& from, const Vec3& wanted) const {
    std::uint32_t now = from.tetrahedron;
    for (int step = 0;; ++step) {
        std::array<Vec3, 4> corners;
        for (std::size_t k = 0; k < 4; ++k) corners[k] = mesh_.vertices[mesh_.tetrahedra[now][k]];
        std::array<double, 4> shares = shares_at(corners, wanted);
        std::uint32_t next = kOutside;
        double most = 0.0;
        bool inside = true;
        for (std::size_t k = 0; k < 4; ++k) {
            inside = inside && shares[k] >= 0.0;
            if (shares[k] >= most || next_[now][k] == kOutside) continue;
            most = shares[k];
            next = next_[now][k];
        }
        if (inside) return {wanted, now};
        if (next != kOutside && step < kStepsAtMost) {
            now = next;
            continue;
        }
        double sum = 0.0;
        for (double& share : shares) sum += share = std::max(share, 0.0);
        Vec3 at{};
        for (std::size_t k = 0; k < 4; ++k) at += corners[k] * (shares[k] / sum);
        return {at, now};
    }
}

TriangleMesh VolumeWalk::skin() const {
    TriangleMesh out;
    out.vertices = mesh_.vertices;
    for (std::size_t t = 0; t < next_.size(); ++t) {
        const auto& v = mesh_.tetrahedra[t];
        for (std::size_t k = 0; k < 4; ++k) {
            if (next_[t][k] != kOutside) continue;
            std::array<std::uint32_t, 3> face{v[(k + 1) % 4], v[(k + 2) % 4], v[(k + 3) % 4]};
            const auto& p = mesh_.vertices;
            if (volume6(p[face[0]], p[face[1]], p[face[2]], p[v[k]]) > 0.0) std::swap(face[1], face[2]);
            out.triangles.push_back(face);
        }
    }
    return out;
}

}  // namespace aerogram::planner
