#include "planner/mesh/surface_walk.hpp"

#include <algorithm>

namespace aerogram::planner {
namespace {

constexpr int kStepsAtMost = 100;

/// The share of the way from a to b that is nearest to p.
double along(const Vec3& p, const Vec3& a, const Vec3& b) {
    const double squared = glm::dot(b - a, b - a);
    return squared > 0.0 ? std::clamp(glm::dot(p - a, b - a) / squared, 0.0, 1.0) : 0.0;
}

}  // namespace

Vec3 nearest_shares(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 u = b - a, v = c - a, w = p - a;
    const Vec3 across = glm::cross(u, v);  // rather than by dot products, which needles leave nothing of
    const double squared_area = glm::dot(across, across);
    if (squared_area > 0.0) {
        const double s = glm::dot(glm::cross(w, v), across) / squared_area;
        const double t = glm::dot(glm::cross(u, w), across) / squared_area;
        if (s >= 0.0 && t >= 0.0 && s + t <= 1.0) return {1.0 - s - t, s, t};
    }
    const double ab = along(p, a, b), bc = along(p, b, c), ca = along(p, c, a);
    const Vec3 on_ab(1.0 - ab, ab, 0.0), on_bc(0.0, 1.0 - bc, bc), on_ca(ca, 0.0, 1.0 - ca);
    const auto squared = [&](const Vec3& shares) {
        const Vec3 d = a * shares.x + b * shares.y + c * shares.z - p;
        return glm::dot(d, d);
    };
    const Vec3& first = squared(on_ab) <= squared(on_bc) ? on_ab : on_bc;
    return squared(first) <= squared(on_ca) ? first : on_ca;
}

SurfaceWalk::SurfaceWalk(const TriangleMesh& mesh) : mesh_(mesh) {
    starts_.assign(mesh.vertices.size() + 1, 0);
    normals_.reserve(mesh.triangles.size());
    for (const auto& t : mesh.triangles) {
        const Vec3& a = mesh.vertices[t[0]];
        const Vec3 across = glm::cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a);
        const double length = glm::length(across);
        normals_.push_back(length > 0.0 ? across / length : Vec3{});
        for (const std::uint32_t v : t) ++starts_[v + 1];
    }
    for (std::size_t v = 1; v < starts_.size(); ++v) starts_[v] += starts_[v - 1];
    around_.resize(starts_.back());
    std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (const std::uint32_t v : mesh.triangles[t]) around_[next[v]++] = t;
    }
}

SurfacePlace SurfaceWalk::towards(const SurfacePlace& from, const Vec3& wanted) const {
    SurfacePlace best = from;
    double best_squared = 1e300;
    std::uint32_t feature[2] = {0, 0};  // the edge, or twice the vertex, that the place is at
    bool inner = false;
    const auto consider = [&](std::uint32_t t) {
        const auto& [i, j, k] = mesh_.triangles[t];
        const Vec3 &a = mesh_.vertices[i], &b = mesh_.vertices[j], &c = mesh_.vertices[k];
        const Vec3 shares = nearest_shares(wanted, a, b, c);
        const Vec3 at = a * shares.x + b * shares.y + c * shares.z;
        const double squared = glm::dot(at - wanted, at - wanted);
        if (squared >= best_squared) return false;
        best = {at, t};
        best_squared = squared;
        std::uint32_t touched[3];
        int corners = 0;
        for (int n = 0; n < 3; ++n) {
            if (shares[n] > 0.0) touched[corners++] = mesh_.triangles[t][static_cast<std::size_t>(n)];
        }
        inner = corners == 3;
        feature[0] = touched[0];
        feature[1] = corners == 2 ? touched[1] : touched[0];
        return true;
    };
    consider(from.triangle);
    for (int step = 0; step < kStepsAtMost && !inner; ++step) {
        const std::uint32_t at = best.triangle, a = feature[0], b = feature[1];
        bool nearer = false;
        for (std::uint32_t k = starts_[a]; k < starts_[a + 1]; ++k) {
            const std::uint32_t t = around_[k];
            const auto& corners = mesh_.triangles[t];
            if (t == at || (corners[0] != b && corners[1] != b && corners[2] != b)) continue;
            nearer = consider(t) || nearer;
        }
        if (!nearer) break;
    }
    return best;
}

}  // namespace aerogram::planner
