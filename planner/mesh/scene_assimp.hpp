#pragma once
#include <filesystem>

#include "geo/result.hpp"
#include "planner/mesh/scene.hpp"

namespace aerogram::planner {

inline constexpr std::uintmax_t kLargestMeshFile = 256U << 20U;

/// Reads a file of one of the mesh kinds; its numbers are of single precision. Opens files in the folder of `file` and
/// below it only. May crash or ask for any memory: to be called in a child process.
/// Colours as linear light: glTF says they are linear, and its vertex colours are multiplied by the material's base
/// colour; other kinds' are sRGB, and vertex colours (OBJ, PLY, STL) go before an OBJ's diffuse colour. Pictures on
/// surfaces are not looked at.
/// Errors: io when `file` or one that it names cannot be read; invalid_input when it is damaged, names a file
/// elsewhere, or has coordinates that are not finite.
Result<Scene> read_scene(const std::filesystem::path& file);

}  // namespace aerogram::planner
