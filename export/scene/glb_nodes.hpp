#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "export/bytes/json_document.hpp"
#include "geo/vec3.hpp"

/// What stands above the nodes of a glTF scene.
namespace aerogram::exporter {

/// p -> columns · p + shift.
struct Affine {
    std::array<Vec3, 3> columns{Vec3{1.0, 0.0, 0.0}, Vec3{0.0, 1.0, 0.0}, Vec3{0.0, 0.0, 1.0}};
    Vec3 shift{};
    [[nodiscard]] Vec3 turned(const Vec3& v) const { return v.x * columns[0] + v.y * columns[1] + v.z * columns[2]; }
    [[nodiscard]] Vec3 operator()(const Vec3& p) const { return turned(p) + shift; }
};

class GlbNodes {
  public:
    /// What is wrong (two parents, a circle, numbers out of range) goes to the problem of `root`.
    explicit GlbNodes(const JsonNode& root);
    [[nodiscard]] std::size_t size() const { return parents_.size(); }
    /// From a node's own place to the scene's: all its ancestors, as they stand. @param moves  nodes that an animation
    /// moves: one of them above the node is a problem.
    [[nodiscard]] Affine above(std::size_t node, const std::vector<bool>& moves) const;

  private:
    static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
    [[nodiscard]] Affine own(std::size_t node) const;

    JsonNode root_, list_;
    std::vector<std::size_t> parents_;
};

}  // namespace aerogram::exporter
