#include "planner/mesh/sharp_edges.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "geo/units.hpp"

namespace aerogram::planner {
namespace {

constexpr double kSharpCosine = 0.8660254037844387;  ///< of 30 degrees
constexpr double kSpike = 0.8 * 2.0 * kPi;           ///< at a spike the triangles' angles have a smaller sum

struct Side {
    std::uint32_t low, high, triangle;
    bool forward;  ///< the triangle goes round from low to high
    bool operator<(const Side& o) const { return std::tie(low, high, triangle) < std::tie(o.low, o.high, o.triangle); }
};
using Pair = std::array<std::uint32_t, 2>;

Vec3 normal_of(const TriangleMesh& mesh, std::uint32_t triangle) {
    const auto& [a, b, c] = mesh.triangles[triangle];
    const Vec3 across = glm::cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]);
    const double length = glm::length(across);
    return length > 0.0 ? across / length : Vec3{};
}

bool is_sharp(const TriangleMesh& mesh, const Side* sides, std::size_t count) {
    if (count != 2) return true;
    const Vec3 n = normal_of(mesh, sides[0].triangle), m = normal_of(mesh, sides[1].triangle);
    if (n == Vec3{} || m == Vec3{}) return false;
    return (sides[0].forward == sides[1].forward ? -1.0 : 1.0) * glm::dot(n, m) < kSharpCosine;
}

std::vector<Pair> sharp_pairs(const TriangleMesh& mesh) {
    std::vector<Side> sides;
    sides.reserve(3 * mesh.triangles.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
            if (a != b) sides.push_back({std::min(a, b), std::max(a, b), t, a < b});
        }
    }
    std::sort(sides.begin(), sides.end());
    std::vector<Pair> out;
    for (std::size_t k = 0; k < sides.size();) {
        std::size_t end = k + 1;
        while (end < sides.size() && sides[end].low == sides[k].low && sides[end].high == sides[k].high) ++end;
        if (is_sharp(mesh, &sides[k], end - k)) out.push_back({sides[k].low, sides[k].high});
        k = end;
    }
    return out;
}

/// Vertices around which the surface lacks this much of a full turn: a cube's corner lacks a quarter.
std::vector<bool> spikes(const TriangleMesh& mesh) {
    std::vector<double> turn(mesh.vertices.size(), 0.0);
    for (const auto& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 a = mesh.vertices[t[(k + 1) % 3]] - mesh.vertices[t[k]];
            const Vec3 b = mesh.vertices[t[(k + 2) % 3]] - mesh.vertices[t[k]];
            turn[t[k]] += std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
        }
    }
    std::vector<bool> out;
    for (const double angle : turn) out.push_back(angle > 0.0 && angle < kSpike);
    return out;
}

/// The sharp edges at each vertex.
class Net {
  public:
    Net(const TriangleMesh& mesh, std::vector<Pair> pairs) : mesh_(mesh), pairs_(std::move(pairs)) {
        starts_.assign(mesh.vertices.size() + 1, 0);
        for (const Pair& pair : pairs_) {
            for (const std::uint32_t v : pair) ++starts_[v + 1];
        }
        for (std::size_t v = 1; v < starts_.size(); ++v) starts_[v] += starts_[v - 1];
        at_.resize(starts_.back());
        std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
        for (std::uint32_t e = 0; e < pairs_.size(); ++e) {
            for (const std::uint32_t v : pairs_[e]) at_[next[v]++] = e;
        }
        walked_.assign(pairs_.size(), false);
    }

    SharpEdges lines() {
        SharpEdges out;
        const std::vector<bool> spike = spikes(mesh_);
        for (std::uint32_t v = 0; v < mesh_.vertices.size(); ++v) {
            if (degree(v) == 0 && spike[v]) out.tips.push_back(v);
            if (!is_corner(v)) continue;
            out.corners.push_back(v);
            if (degree(v) > 2) out.tips.push_back(v);
            for (std::uint32_t k = starts_[v]; k < starts_[v + 1]; ++k) {
                if (!walked_[at_[k]]) out.lines.push_back(line_from(v, at_[k]));
            }
        }
        for (std::uint32_t e = 0; e < pairs_.size(); ++e) {
            if (!walked_[e]) out.lines.push_back(line_from(pairs_[e][0], e));
        }
        return out;
    }

  private:
    [[nodiscard]] std::uint32_t degree(std::uint32_t v) const { return starts_[v + 1] - starts_[v]; }
    [[nodiscard]] std::uint32_t other_end(std::uint32_t edge, std::uint32_t v) const {
        return pairs_[edge][0] == v ? pairs_[edge][1] : pairs_[edge][0];
    }
    [[nodiscard]] bool is_corner(std::uint32_t v) const {
        if (degree(v) != 2) return degree(v) > 0;
        const Vec3 a = mesh_.vertices[v] - mesh_.vertices[other_end(at_[starts_[v]], v)];
        const Vec3 b = mesh_.vertices[other_end(at_[starts_[v] + 1], v)] - mesh_.vertices[v];
        return glm::dot(a, b) < kSharpCosine * glm::length(a) * glm::length(b);
    }
    SharpLine line_from(std::uint32_t v, std::uint32_t edge) {
        SharpLine line;
        line.vertices.push_back(v);
        line.closed = !is_corner(v);
        while (!walked_[edge]) {
            walked_[edge] = true;
            v = other_end(edge, v);
            line.vertices.push_back(v);
            if (is_corner(v)) break;
            edge = at_[starts_[v]] == edge ? at_[starts_[v] + 1] : at_[starts_[v]];
        }
        return line;
    }

    const TriangleMesh& mesh_;
    std::vector<Pair> pairs_;
    std::vector<std::uint32_t> starts_, at_;
    std::vector<bool> walked_;
};

}  // namespace

SharpEdges sharp_edges_of(const TriangleMesh& mesh) {
    return Net(mesh, sharp_pairs(mesh)).lines();
}

LineTrack::LineTrack(const TriangleMesh& mesh, const SharpLine& line) : along_{0.0}, closed_(line.closed) {
    for (const std::uint32_t v : line.vertices) {
        if (!points_.empty()) along_.push_back(along_.back() + glm::distance(points_.back(), mesh.vertices[v]));
        points_.push_back(mesh.vertices[v]);
    }
}

Vec3 LineTrack::at(double distance) const {
    if (length() <= 0.0) return points_.front();
    if (closed_) distance -= length() * std::floor(distance / length());
    distance = std::clamp(distance, 0.0, length());
    const auto after = std::upper_bound(along_.begin() + 1, along_.end() - 1, distance);
    const auto i = static_cast<std::size_t>(after - along_.begin()) - 1;
    const double step = along_[i + 1] - along_[i];
    return step > 0.0 ? points_[i] + (points_[i + 1] - points_[i]) * ((distance - along_[i]) / step) : points_[i];
}

}  // namespace aerogram::planner
