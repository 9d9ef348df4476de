#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "geo/result.hpp"
#include "planner/mesh/triangle_mesh.hpp"

namespace aerogram::planner {

/// Which instant of a file's animation: `index` of `count` equally far apart, first and last included.
struct MeshInstant {
    std::size_t index = 0, count = 1;
    std::string clip;  ///< the animation's name; empty: the first
};

struct ReadMesh {
    TriangleMesh mesh;  ///< as the file stores it, its own axes; all parts of the scene in their places
    bool y_up = false;  ///< the convention of the file's kind: glTF and OBJ have y up and z towards the viewer
};

inline constexpr std::size_t kMostVertices = 5'000'000;

/// Reads OBJ, STL, PLY, glTF or GLB. Vertices at the same place are one; triangles without area are dropped. With an
/// instant: bones, node transforms and morph targets as they are then; vertices and triangles correspond between
/// instants of one file: vertices are joined where they are at rest. Between keys straight lines and shortest turns.
/// Places are of single precision. Colours: vertex colours and materials' base colours as linear light
/// (scene_assimp.hpp), pictures on surfaces not looked at. Never opens a file outside the folder of `file`, and no
/// network address. The library reads in a child process, 4 s and 1 s a MiB of processor time at most (a million
/// vertices take 1-3 s). Errors: io when it cannot be read or is larger than 256 MiB; invalid_input when it is none of
/// these, damaged, has coordinates that are not finite, no triangle, too many vertices, or not that animation (names
/// those there are).
Result<ReadMesh> read_mesh(const std::filesystem::path& file, const std::optional<MeshInstant>& instant);

}  // namespace aerogram::planner
