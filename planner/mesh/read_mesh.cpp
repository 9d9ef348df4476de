#include "planner/mesh/read_mesh.hpp"

#include <algorithm>
#include <fstream>
#include <system_error>

#include "geo/contract.hpp"
#include "planner/mesh/child_process.hpp"
#include "planner/mesh/ply_header.hpp"
#include "planner/mesh/scene_assimp.hpp"
#include "planner/mesh/wire.hpp"

namespace aerogram::planner {
namespace {

constexpr const char* kKinds = "must be an OBJ, STL, PLY, glTF or GLB file";
/// Before equal ones are joined: three for every triangle of the largest STL file.
constexpr std::size_t kMostStored = 4 * kMostVertices;

Error refused(const std::string& why) {
    return {ErrorCode::invalid_input, why};
}

std::string ending_of(const std::filesystem::path& file) {
    std::string ending = file.extension().string();
    for (char& c : ending)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return ending;
}

std::string front_of(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::string bytes(kLongestPlyHeader, '\0');
    in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0)));
    return bytes;
}

Result<const SceneClip*> clip_of(const Scene& scene, const MeshInstant& instant) {
    if (scene.clips.empty()) return refused("has no animation");
    if (instant.clip.empty()) return &scene.clips.front();
    std::string names;
    for (const SceneClip& clip : scene.clips) {
        if (clip.name == instant.clip) return &clip;
        names += (names.empty() ? "\"" : ", \"") + clip.name + "\"";
    }
    return refused("has no animation \"" + instant.clip + "\": must be one of " + names);
}

/// What the child does; see read_mesh.
Result<std::string> packed_mesh(const std::filesystem::path& file, const std::optional<MeshInstant>& instant) {
    const auto scene = read_scene(file);
    if (!scene) return scene.error();
    const auto [vertices, triangles] = posed_size(*scene);
    if (vertices > kMostStored || triangles > kMostStored)
        return refused("has too many vertices: must have at most " + std::to_string(kMostVertices));
    if (triangles == 0) return refused("has no triangle");
    TriangleMesh rest = posed(*scene, nullptr, 0.0), then = rest;
    if (instant) {
        const auto clip = clip_of(*scene, *instant);
        if (!clip) return clip.error();
        const double share =
            instant->count > 1 ? static_cast<double>(instant->index) / static_cast<double>(instant->count - 1) : 0.0;
        then = posed(*scene, *clip, (*clip)->begin + share * ((*clip)->end - (*clip)->begin));
    }
    for (const TriangleMesh* mesh : {&rest, &then})
        if (!std::all_of(mesh->vertices.begin(), mesh->vertices.end(), is_finite))
            return refused("has coordinates that are not finite");
    const TriangleMesh mesh = welded(rest, then);
    if (mesh.triangles.empty()) return refused("has no triangle with an area");
    if (mesh.vertices.size() > kMostVertices)
        return refused("has " + std::to_string(mesh.vertices.size()) + " vertices: must have at most " +
                       std::to_string(kMostVertices));
    WireWriter writer;
    writer.add(mesh.vertices);
    writer.add(mesh.triangles);
    writer.add(mesh.colors);
    return writer.take();
}

bool unpacked(const std::string& bytes, TriangleMesh& mesh) {
    WireReader reader(bytes);
    bool sound = reader.take(mesh.vertices) && reader.take(mesh.triangles) && reader.take(mesh.colors) &&
                 reader.at_end() && (mesh.colors.empty() || mesh.colors.size() == mesh.vertices.size());
    for (const Vec3& v : mesh.vertices) sound = sound && is_finite(v);
    for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t corner : triangle) sound = sound && corner < mesh.vertices.size();
    return sound;
}

}  // namespace

Result<ReadMesh> read_mesh(const std::filesystem::path& file, const std::optional<MeshInstant>& instant) {
    AEROGRAM_REQUIRE(!instant || instant->index < instant->count, instant->index, instant->count);
    const std::string ending = ending_of(file);
    const bool gltf = ending == ".gltf" || ending == ".glb", obj = ending == ".obj";
    if (!gltf && !obj && ending != ".stl" && ending != ".ply")
        return refused("is no mesh that can be read: " + std::string(kKinds));
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) return Error{ErrorCode::io, "cannot be read"};
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    if (error) return Error{ErrorCode::io, "cannot be read"};
    if (size > kLargestMeshFile) return Error{ErrorCode::io, "is larger than 256 MiB: must be smaller"};
    if (ending == ".ply")
        if (const std::string fault = fault_of_ply(front_of(file), size); !fault.empty()) return refused(fault);
    // Damaged files send the library into endless loops: time is given by size, ten times what sound files need.
    ChildLimits limits;
    limits.cpu_s = 4 + static_cast<unsigned>(size >> 20U);
    limits.wall_s = 30 * limits.cpu_s;
    const auto bytes = run_in_child(
        "the mesh reader", [&] { return packed_mesh(file, instant); }, limits, Run{});
    if (!bytes) return bytes.error();
    ReadMesh out;
    out.y_up = gltf || obj;
    if (!unpacked(*bytes, out.mesh)) return refused("is damaged: no sound mesh came of it");
    return out;
}

}  // namespace aerogram::planner
