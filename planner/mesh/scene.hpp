#pragma once
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner/mesh/triangle_mesh.hpp"

namespace aerogram::planner {

/// What a file of the mesh kinds holds, before its parts are put in their places.
struct SceneBone {
    std::uint32_t node = 0;
    glm::dmat4 offset{1.0};                                 ///< from the part to the node, both at rest
    std::vector<std::pair<std::uint32_t, double>> weights;  ///< by vertex
};

struct ScenePart {
    TriangleMesh mesh;            ///< colours: always one a vertex, white without any
    bool colored = false;         ///< the file says so
    std::vector<Points> targets;  ///< of morphing, each a place a vertex
    std::vector<double> target_weights;
    std::vector<SceneBone> bones;  ///< none: it goes with its node
};

struct SceneNode {
    std::uint32_t parent = 0;  ///< a smaller index; the first is its own
    glm::dmat4 local{1.0};
    std::vector<std::uint32_t> parts;
};

template <class T>
struct SceneKey {
    double time = 0.0;
    T value{};
};

/// How a node moves; a part without keys stays as the node's own.
struct NodeTrack {
    std::uint32_t node = 0;
    std::vector<SceneKey<Vec3>> moves, scales;
    std::vector<SceneKey<glm::dquat>> turns;
};

/// How the morph targets of a node's parts are weighted.
struct WeightTrack {
    std::uint32_t node = 0;
    std::vector<SceneKey<std::vector<double>>> weights;
};

struct SceneClip {
    std::string name;
    std::vector<NodeTrack> nodes;
    std::vector<WeightTrack> morphs;
    double begin = 0.0, end = 0.0;  ///< the first and the last key
};

struct Scene {
    std::vector<ScenePart> parts;
    std::vector<SceneNode> nodes;
    std::vector<SceneClip> clips;
};

/// All parts of the scene at an instant, in their places, one after another: vertices are not joined yet. Between keys:
/// straight lines and shortest turns, whatever the file asks for.
/// @param clip  none: at rest. @param time  on the clip's clock.
[[nodiscard]] TriangleMesh posed(const Scene& scene, const SceneClip* clip, double time);

/// How many vertices and triangles `posed` gives.
[[nodiscard]] std::pair<std::size_t, std::size_t> posed_size(const Scene& scene);

/// Joins vertices that are at one place at rest and leaves out triangles that have no area there, and vertices without
/// a triangle. @param then  the same scene at an instant, or at rest: its places are those of the result.
[[nodiscard]] TriangleMesh welded(const TriangleMesh& rest, const TriangleMesh& then);

}  // namespace aerogram::planner
