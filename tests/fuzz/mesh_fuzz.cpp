#include <unistd.h>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "planner/mesh/mesh_faults.hpp"
#include "planner/mesh/ply_header.hpp"
#include "planner/mesh/read_mesh.hpp"

// Fuzz target: the first line is a file's ending ("obj"), the rest its bytes. They are a sound mesh, whose faults can
// be told and whose triangles can be turned, or are refused with a message; nothing else may happen.
// Build with -fsanitize=fuzzer,address,undefined; the corpus is tests/fuzz/corpus/mesh, replayed by a unit test.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace aerogram::planner::fuzz {

inline void insist(bool holds) {
    if (!holds) std::abort();
}

inline void try_mesh(std::string_view bytes) {
    const std::size_t line = bytes.find('\n');
    if (line == std::string_view::npos || line > 4) return;
    const std::string ending(bytes.substr(0, line));
    for (const char c : ending)
        if (c < 'a' || c > 'z') return;
    bytes.remove_prefix(line + 1);
    const std::string fault = fault_of_ply(bytes.substr(0, kLongestPlyHeader), bytes.size());
    insist(fault.empty() || fault.starts_with("is damaged: "));
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / ("aerogram_mesh_fuzz_" + std::to_string(::getpid()) + "." + ending);
    std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    for (const auto& instant : {std::optional<MeshInstant>{}, std::optional<MeshInstant>{{1, 3, ""}}}) {
        const auto read = read_mesh(file, instant);
        if (!read) {
            insist(!read.error().message.empty() && read.error().message.find('\n') == std::string::npos);
            continue;
        }
        const TriangleMesh& mesh = read->mesh;
        insist(!mesh.triangles.empty() && (mesh.colors.empty() || mesh.colors.size() == mesh.vertices.size()));
        for (const Vec3& v : mesh.vertices) insist(is_finite(v));
        for (const auto& [a, b, c] : mesh.triangles)
            insist(a < mesh.vertices.size() && b < mesh.vertices.size() && c < mesh.vertices.size() && a != b &&
                   b != c && c != a);
        insist(turned_outwards(mesh).triangles.size() == mesh.triangles.size());
        (void)faults_of(mesh);
    }
    std::filesystem::remove(file);
}

}  // namespace aerogram::planner::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    aerogram::planner::fuzz::try_mesh({size > 0 ? reinterpret_cast<const char*>(data) : "", size});
    return 0;
}
