#include <algorithm>
#include <cmath>

#include "planner/mesh/scene.hpp"

namespace aerogram::planner {
namespace {

/// A node's matrix taken apart.
struct Placement {
    Vec3 move{};
    Vec3 scale{1.0, 1.0, 1.0};
    glm::dquat turn{1.0, 0.0, 0.0, 0.0};

    explicit Placement(const glm::dmat4& m) : move(m[3]) {
        glm::dmat3 axes(m);
        for (int k = 0; k < 3; ++k) {
            scale[k] = glm::length(axes[k]);
            if (scale[k] > 0.0) axes[k] /= scale[k];
        }
        if (glm::determinant(axes) < 0.0) {
            scale = -scale;
            axes = -axes;
        }
        turn = glm::normalize(glm::quat_cast(axes));
    }
    [[nodiscard]] glm::dmat4 matrix() const {
        glm::dmat4 m = glm::mat4_cast(turn);
        for (int k = 0; k < 3; ++k) m[k] *= scale[k];
        m[3] = {move, 1.0};
        return m;
    }
};

Vec3 between(const Vec3& from, const Vec3& to, double share) {
    return from + share * (to - from);
}
glm::dquat between(const glm::dquat& from, const glm::dquat& to, double share) {
    return glm::normalize(glm::slerp(glm::normalize(from), glm::normalize(to), share));
}
std::vector<double> between(std::vector<double> from, const std::vector<double>& to, double share) {
    for (std::size_t k = 0; k < std::min(from.size(), to.size()); ++k) from[k] += share * (to[k] - from[k]);
    return from;
}

/// @param keys  at least one, ascending.
template <class T>
T value_at(const std::vector<SceneKey<T>>& keys, double time) {
    const auto after =
        std::upper_bound(keys.begin(), keys.end(), time, [](double t, const SceneKey<T>& k) { return t < k.time; });
    if (after == keys.begin()) return keys.front().value;
    if (after == keys.end()) return keys.back().value;
    const auto before = after - 1;
    return between(before->value, after->value, (time - before->time) / (after->time - before->time));
}

std::vector<glm::dmat4> places_of_nodes(const Scene& scene, const SceneClip* clip, double time) {
    std::vector<glm::dmat4> places;
    for (const SceneNode& node : scene.nodes) places.push_back(node.local);
    if (clip != nullptr)
        for (const NodeTrack& track : clip->nodes) {
            Placement placement(scene.nodes[track.node].local);
            if (!track.moves.empty()) placement.move = value_at(track.moves, time);
            if (!track.scales.empty()) placement.scale = value_at(track.scales, time);
            if (!track.turns.empty()) placement.turn = value_at(track.turns, time);
            places[track.node] = placement.matrix();
        }
    for (std::size_t i = 1; i < places.size(); ++i) places[i] = places[scene.nodes[i].parent] * places[i];
    return places;
}

Points morphed(const ScenePart& part, const std::vector<double>& weights) {
    Points out = part.mesh.vertices;
    for (std::size_t k = 0; k < part.targets.size() && k < weights.size(); ++k) {
        if (weights[k] == 0.0) continue;
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] += weights[k] * (part.targets[k][i] - part.mesh.vertices[i]);
    }
    return out;
}

Vec3 moved(const glm::dmat4& by, const Vec3& p) {
    return Vec3(by * glm::dvec4(p, 1.0));
}

/// Bones carry their vertices, shares made to add up to 1; a vertex without bones goes with its node.
void carry(Points& points, const ScenePart& part, const std::vector<glm::dmat4>& places, const glm::dmat4& own) {
    Points carried(points.size());
    std::vector<double> sum(points.size(), 0.0);
    for (const SceneBone& bone : part.bones) {
        const glm::dmat4 by = places[bone.node] * bone.offset;
        for (const auto& [vertex, weight] : bone.weights) {
            carried[vertex] += weight * moved(by, points[vertex]);
            sum[vertex] += weight;
        }
    }
    for (std::size_t i = 0; i < points.size(); ++i)
        points[i] = sum[i] > 0.0 ? carried[i] / sum[i] : moved(own, points[i]);
}

void add_part(TriangleMesh& to, const ScenePart& part, Points&& points, bool mirrored) {
    const auto offset = static_cast<std::uint32_t>(to.vertices.size());
    to.vertices.insert(to.vertices.end(), points.begin(), points.end());
    to.colors.insert(to.colors.end(), part.mesh.colors.begin(), part.mesh.colors.end());
    for (const auto& [a, b, c] : part.mesh.triangles) {
        const std::uint32_t second = mirrored ? c : b, third = mirrored ? b : c;
        to.triangles.push_back({a + offset, second + offset, third + offset});
    }
}

}  // namespace

TriangleMesh posed(const Scene& scene, const SceneClip* clip, double time) {
    const std::vector<glm::dmat4> places = places_of_nodes(scene, clip, time),
                                  rest = places_of_nodes(scene, nullptr, 0);
    TriangleMesh all;
    bool colored = false;
    for (std::uint32_t n = 0; n < scene.nodes.size(); ++n) {
        const WeightTrack* track = nullptr;
        if (clip != nullptr)
            for (const WeightTrack& candidate : clip->morphs)
                if (candidate.node == n && !candidate.weights.empty()) track = &candidate;
        for (const std::uint32_t p : scene.nodes[n].parts) {
            const ScenePart& part = scene.parts[p];
            Points points = morphed(part, track == nullptr ? part.target_weights : value_at(track->weights, time));
            carry(points, part, places, places[n]);
            const bool mirrored = part.bones.empty() && glm::determinant(glm::dmat3(rest[n])) < 0.0;
            add_part(all, part, std::move(points), mirrored);
            colored = colored || part.colored;
        }
    }
    if (!colored) all.colors.clear();
    return all;
}

std::pair<std::size_t, std::size_t> posed_size(const Scene& scene) {
    std::pair<std::size_t, std::size_t> size{0, 0};
    for (const SceneNode& node : scene.nodes)
        for (const std::uint32_t part : node.parts) {
            size.first += scene.parts[part].mesh.vertices.size();
            size.second += scene.parts[part].mesh.triangles.size();
        }
    return size;
}

}  // namespace aerogram::planner
