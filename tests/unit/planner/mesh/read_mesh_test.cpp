#include "planner/mesh/read_mesh.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <numbers>

#include "planner/mesh/mesh_faults.hpp"
#include "planner/mesh/mesh_measure.hpp"
#include "solids_by_hand.hpp"

namespace aerogram::planner {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const fs::path kMeshes = fs::path(AEROGRAM_SOURCE_DIR) / "tests/unit/planner/mesh/meshes";

TriangleMesh mesh_of(const fs::path& file, const std::optional<MeshInstant>& instant = {}) {
    const auto read = read_mesh(file, instant);
    EXPECT_TRUE(read.ok()) << file << ": " << (read ? "" : read.error().message);
    return read ? read->mesh : TriangleMesh{};
}

TriangleMesh at(const char* file, std::size_t index, std::size_t count, const char* clip = "") {
    return mesh_of(kMeshes / file, MeshInstant{index, count, clip});
}

std::string refusal(const fs::path& file, const std::optional<MeshInstant>& instant = {},
                    ErrorCode code = ErrorCode::invalid_input) {
    const auto read = read_mesh(file, instant);
    EXPECT_FALSE(read.ok()) << file;
    if (read) return {};
    EXPECT_EQ(read.error().code, code);
    return read.error().message;
}

/// Its box, [low, high].
std::pair<Vec3, Vec3> box_of(const TriangleMesh& mesh) {
    Vec3 low(HUGE_VAL), high(-HUGE_VAL);
    for (const Vec3& v : mesh.vertices) {
        low = glm::min(low, v);
        high = glm::max(high, v);
    }
    return {low, high};
}

void expect_box(const TriangleMesh& mesh, const Vec3& low, const Vec3& high) {
    const auto [l, h] = box_of(mesh);
    EXPECT_LE(glm::length(l - low), 1e-5) << l.x << " " << l.y << " " << l.z;
    EXPECT_LE(glm::length(h - high), 1e-5) << h.x << " " << h.y << " " << h.z;
}

double area_of(const TriangleMesh& mesh) {
    double sum = 0.0;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) sum += planner::area_of(mesh, t);
    return sum;
}

std::string bytes_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

fs::path written(const std::string& name, const std::string& bytes) {
    const fs::path folder = fs::path(::testing::TempDir()) / "aerogram_read_mesh_test";
    fs::create_directories(folder);
    std::ofstream(folder / name, std::ios::binary) << bytes;
    return folder / name;
}

/// Numbers of make_meshes.py; trimesh 4.12 reads the same volumes, areas and boxes from these files.
TEST(ReadMesh, TheSameBlockInEveryKind) {
    for (const char* file : {"ascii.stl", "binary.stl", "ascii.ply", "binary.ply", "block.obj", "separate.gltf"}) {
        SCOPED_TRACE(file);
        const auto read = read_mesh(kMeshes / file, {});
        ASSERT_TRUE(read.ok()) << read.error().message;
        EXPECT_EQ(read->mesh.vertices.size(), 8U);
        EXPECT_EQ(read->mesh.triangles.size(), 12U);
        EXPECT_EQ(faults_of(read->mesh), "");
        EXPECT_NEAR(enclosed_volume(read->mesh), 24.0, 1e-9);
        EXPECT_NEAR(area_of(read->mesh), 52.0, 1e-9);
        expect_box(read->mesh, {-1, -1.5, -2}, {1, 1.5, 2});
        const std::string ending = fs::path(file).extension();
        EXPECT_EQ(read->y_up, ending == ".obj" || ending == ".gltf");
    }
}

TEST(ReadMesh, EndingsMayBeCapitals) {
    EXPECT_EQ(mesh_of(written("BLOCK.STL", bytes_of(kMeshes / "binary.stl"))).triangles.size(), 12U);
}

TEST(ReadMesh, PlacesOfTheSceneAreApplied) {
    const TriangleMesh mesh = mesh_of(kMeshes / "placed.gltf");
    EXPECT_EQ(mesh.triangles.size(), 24U);
    expect_box(mesh, {-3, -11, -4}, {3, 12, 4});
    EXPECT_NEAR(enclosed_volume(mesh), 8.0 * 24.0 + 24.0, 1e-3);  // the mirrored one faces outwards too
    EXPECT_EQ(faults_of(mesh), "");
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
        EXPECT_EQ(mesh.colors[i], mesh.vertices[i].y > 0.0 ? (Rgb{1, 0, 0}) : (Rgb{0, 0.5, 0}));
}

TEST(ReadMesh, ColorsAreLinear) {
    const auto linear = [](double s) { return std::pow((s + 0.055) / 1.055, 2.4); };
    for (const char* file : {"ascii.ply", "binary.ply"}) {
        const TriangleMesh mesh = mesh_of(kMeshes / file);
        ASSERT_EQ(mesh.colors.size(), mesh.vertices.size());
        for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
            EXPECT_EQ(mesh.colors[i].r, mesh.vertices[i].x > 0.0 ? 1.0 : 0.0);
            EXPECT_NEAR(mesh.colors[i].g, linear(128 / 255.0), 1e-7);
            EXPECT_NEAR(mesh.colors[i].b, linear(64 / 255.0), 1e-7);
        }
    }
    const TriangleMesh painted = mesh_of(kMeshes / "block.obj");
    ASSERT_EQ(painted.colors.size(), 8U);
    EXPECT_NEAR(painted.colors[3].r, linear(0.5), 1e-7);
    EXPECT_EQ(painted.colors[3].g, 1.0);
    EXPECT_NEAR(painted.colors[3].b, linear(0.25), 1e-7);
    // glTF's numbers are linear as they stand, and vertex times material.
    const TriangleMesh both = mesh_of(kMeshes / "colored.gltf");
    for (std::size_t i = 0; i < both.vertices.size(); ++i)
        EXPECT_EQ(both.colors[i], both.vertices[i].x > 0.0 ? (Rgb{0.25, 0.5, 0.25}) : (Rgb{0.5, 0.0, 0.0}));
}

TEST(ReadMesh, WithoutColorsThereAreNone) {
    for (const char* file : {"ascii.stl", "binary.stl", "separate.gltf", "moving.gltf"})
        EXPECT_TRUE(mesh_of(kMeshes / file).colors.empty()) << file;
    const std::string text = bytes_of(kMeshes / "block.obj");
    EXPECT_TRUE(mesh_of(written("bare.obj", text.substr(text.find("v ")))).colors.empty());
}

TEST(ReadMesh, NodesMove) {
    for (const auto& [index, x] : std::map<std::size_t, double>{{0, 0.0}, {1, 1.0}, {2, 2.0}, {3, 5.0}, {4, 8.0}})
        expect_box(at("moving.gltf", index, 5, "slide"), {x - 1, -1.5, -2}, {x + 1, 1.5, 2});
    expect_box(at("moving.gltf", 0, 1, "slide"), {-1, -1.5, -2}, {1, 1.5, 2});
    expect_box(at("moving.gltf", 1, 3), {0.0 + 1.0, -1.5, -2}, {3, 1.5, 2});  // the first clip is "slide"
}

TEST(ReadMesh, NodesTurnTheShortWayRound) {
    const TriangleMesh rest = mesh_of(kMeshes / "moving.gltf");
    for (std::size_t index = 0; index <= 8; ++index) {
        const double angle = std::numbers::pi * static_cast<double>(index) / 8.0;
        const TriangleMesh turned = at("moving.gltf", index, 9, "spin");
        ASSERT_EQ(turned.triangles, rest.triangles);
        for (std::size_t i = 0; i < rest.vertices.size(); ++i) {
            const Vec3& p = rest.vertices[i];
            const Vec3 expected{std::cos(angle) * p.x - std::sin(angle) * p.y,
                                std::sin(angle) * p.x + std::cos(angle) * p.y, p.z};
            EXPECT_LE(glm::length(turned.vertices[i] - expected), 1e-5);
        }
    }
}

TEST(ReadMesh, MorphTargetsAreWeighted) {
    expect_box(mesh_of(kMeshes / "morphing.gltf"), {-1, -1.5, -2}, {1.5, 1.5, 2});  // the file's own weights: 0, 0.5
    expect_box(at("morphing.gltf", 0, 5), {-1, -1.5, -2}, {1, 1.5, 2});
    expect_box(at("morphing.gltf", 1, 5), {-1, -1.5, -2}, {1, 1.5, 4});
    expect_box(at("morphing.gltf", 2, 5), {-1, -1.5, -2}, {1, 1.5, 6});
    expect_box(at("morphing.gltf", 3, 5), {-1, -1.5, -2}, {1.5, 1.5, 4});
    expect_box(at("morphing.gltf", 4, 5), {-1, -1.5, -2}, {2, 1.5, 2});
}

TEST(ReadMesh, BonesCarryTheirVertices) {
    const TriangleMesh rest = mesh_of(kMeshes / "bent.gltf");
    for (std::size_t index = 0; index <= 4; ++index) {
        const double angle = 0.5 * std::numbers::pi * static_cast<double>(index) / 4.0;
        const TriangleMesh bent = at("bent.gltf", index, 5);
        ASSERT_EQ(bent.vertices.size(), rest.vertices.size());
        for (std::size_t i = 0; i < rest.vertices.size(); ++i) {
            const Vec3& p = rest.vertices[i];
            const Vec3 up{p.x, std::cos(angle) * p.y - std::sin(angle) * p.z,
                          std::sin(angle) * p.y + std::cos(angle) * p.z};
            EXPECT_LE(glm::length(bent.vertices[i] - (p.z > 0.0 ? up : p)), 1e-5);
        }
    }
}

TEST(ReadMesh, InstantsCorrespond) {
    const fs::path bird = fs::path(AEROGRAM_SOURCE_DIR) / "missions/assets/bird.glb";
    const TriangleMesh rest = mesh_of(bird);
    EXPECT_EQ(faults_of(rest), "");
    ASSERT_FALSE(rest.colors.empty());
    Points first;
    for (std::size_t index = 0; index <= 12; index += 3) {
        const TriangleMesh then = mesh_of(bird, MeshInstant{index, 13, "flap"});
        EXPECT_EQ(then.triangles, rest.triangles);
        EXPECT_EQ(then.colors, rest.colors);
        EXPECT_EQ(faults_of(then), "");
        EXPECT_NEAR(enclosed_volume(then), enclosed_volume(rest), 0.05 * enclosed_volume(rest));
        if (index == 0) first = then.vertices;
        double farthest = 0.0;
        for (std::size_t i = 0; i < first.size(); ++i)
            farthest = std::max(farthest, glm::length(then.vertices[i] - first[i]));
        EXPECT_TRUE(index != 6 || farthest > 0.5);
        EXPECT_TRUE(index != 12 || farthest < 1e-5);  // it loops
    }
}

TEST(ReadMesh, AnimationsThatAreNotThereAreNamed) {
    EXPECT_EQ(refusal(kMeshes / "moving.gltf", MeshInstant{0, 2, "jump"}),
              "has no animation \"jump\": must be one of \"slide\", \"spin\"");
    EXPECT_EQ(refusal(kMeshes / "block.obj", MeshInstant{0, 2, ""}), "has no animation");
}

TEST(ReadMesh, OtherFilesAreRefused) {
    EXPECT_THAT(refusal(kMeshes / "make_meshes.py"), HasSubstr("must be an OBJ, STL, PLY, glTF or GLB file"));
    EXPECT_EQ(refusal(kMeshes / "no_such.obj", {}, ErrorCode::io), "cannot be read");
    EXPECT_EQ(refusal(kMeshes / "../meshes", {}),
              "is no mesh that can be read: must be an OBJ, STL, PLY, glTF or GLB file");
    for (const char* ending : {"obj", "stl", "ply", "gltf", "glb"}) {
        EXPECT_FALSE(refusal(written(std::string("empty.") + ending, "")).empty());
        EXPECT_FALSE(refusal(written(std::string("words.") + ending, "These are words, not triangles.\n")).empty());
    }
    // A kind that the library could read and we do not promise, under the name of one that we do.
    EXPECT_FALSE(refusal(written("off.ply", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")).empty());
}

TEST(ReadMesh, FilesElsewhereAreNotOpened) {
    const char* rule = ": only files in its own folder are opened";
    EXPECT_EQ(refusal(kMeshes / "outside.gltf"), std::string("names \"../meshes.bin\"") + rule);
    EXPECT_EQ(refusal(kMeshes / "absolute.gltf"), std::string("names \"/etc/passwd\"") + rule);
    EXPECT_EQ(refusal(kMeshes / "address.gltf"), std::string("names \"http://localhost/block.bin\"") + rule);
    EXPECT_THAT(refusal(kMeshes / "missing.gltf"), HasSubstr("missing.bin"));
    const fs::path obj = written("paint.obj", "mtllib ../../secret.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    EXPECT_THAT(refusal(obj), HasSubstr("only files in its own folder"));
    // A link that leads out of the folder.
    const fs::path link = obj.parent_path() / "separate.bin";
    fs::remove(link);
    fs::create_symlink(kMeshes / "separate.bin", link);
    EXPECT_THAT(refusal(written("linked.gltf", bytes_of(kMeshes / "separate.gltf"))),
                HasSubstr("only files in its own"));
    fs::remove(link);
}

TEST(ReadMesh, WhatIsNoSurfaceIsRefused) {
    EXPECT_EQ(refusal(kMeshes / "points.ply"), "has no triangle");
    EXPECT_EQ(refusal(kMeshes / "lines.obj"), "has no triangle");
    EXPECT_EQ(refusal(written("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")), "has no triangle with an area");
    EXPECT_EQ(refusal(kMeshes / "nan.stl"), "has coordinates that are not finite");
    EXPECT_EQ(refusal(written("far.obj", "v 0 0 0\nv 1e60 0 0\nv 0 1 0\nf 1 2 3\n")),
              "has coordinates that are not finite");
}

TEST(ReadMesh, DamageIsAnError) {
    for (const char* file :
         {"wrong_index.obj", "wrong_index.ply", "wrong_index.gltf", "boast.stl", "boast.ply", "boast.gltf"})
        EXPECT_THAT(refusal(kMeshes / file),
                    ::testing::AnyOf(StartsWith("is damaged: "), StartsWith("the mesh reader ")))
            << file;
}

TEST(ReadMesh, CutShortIsAMeshOrAnError) {
    std::size_t errors = 0;
    for (const char* file : {"ascii.stl", "binary.stl", "ascii.ply", "binary.ply", "block.obj", "moving.gltf"}) {
        const std::string whole = bytes_of(kMeshes / file);
        for (std::size_t part = 0; part < 16; ++part) {
            const fs::path cut = written(std::string("cut_") + file, whole.substr(0, whole.size() * part / 16));
            const auto read = read_mesh(cut, {});
            if (!read) {
                ++errors;
                EXPECT_FALSE(read.error().message.empty());
                continue;
            }
            for (const auto& triangle : read->mesh.triangles)
                for (const std::uint32_t corner : triangle) ASSERT_LT(corner, read->mesh.vertices.size());
        }
    }
    EXPECT_GT(errors, 60U);
    const std::string bird = bytes_of(fs::path(AEROGRAM_SOURCE_DIR) / "missions/assets/bird.glb");
    for (std::size_t part = 0; part < 16; ++part)
        EXPECT_FALSE(refusal(written("cut.glb", bird.substr(0, bird.size() * part / 16))).empty());
}

/// The bytes of a mesh as STL stores it: three vertices of its own for every triangle.
std::string stl_of(const TriangleMesh& mesh) {
    std::string bytes(80, '\0');
    const auto add = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
    add(static_cast<std::uint32_t>(mesh.triangles.size()));
    for (const auto& triangle : mesh.triangles) {
        add(std::array<float, 3>{});
        for (const std::uint32_t corner : triangle)
            for (int k = 0; k < 3; ++k) add(static_cast<float>(mesh.vertices[corner][k]));
        add(std::uint16_t{0});
    }
    return bytes;
}

TEST(ReadMesh, AMillionStoredVerticesAreJoined) {
    const TriangleMesh ring = testing::ring(5.0, 2.0, 600, 280);
    const TriangleMesh read = mesh_of(written("large.stl", stl_of(ring)));
    EXPECT_EQ(read.vertices.size(), ring.vertices.size());
    EXPECT_EQ(read.triangles.size(), 336'000U);
    EXPECT_NEAR(enclosed_volume(read), enclosed_volume(ring), 1e-4);
}

TEST(ReadMesh, TooManyVerticesAreCountedBeforeTheyAreMade) {
    // A thousand nodes, each with the same mesh of thirty thousand triangles.
    const TriangleMesh ring = testing::ring(5.0, 2.0, 150, 100);
    std::string bin;
    for (const auto& triangle : ring.triangles)
        for (const std::uint32_t corner : triangle)
            for (int k = 0; k < 3; ++k) {
                const auto v = static_cast<float>(ring.vertices[corner][k]);
                bin.append(reinterpret_cast<const char*>(&v), sizeof v);
            }
    written("many.bin", bin);
    const std::string count = std::to_string(3 * ring.triangles.size()), length = std::to_string(bin.size());
    std::string nodes, numbers;
    for (int i = 0; i < 1000; ++i) {
        nodes += std::string(i == 0 ? "" : ",") + "{\"mesh\":0}";
        numbers += (i == 0 ? "" : ",") + std::to_string(i);
    }
    const fs::path file =
        written("many.gltf", "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[" + numbers +
                                 "]}],\"nodes\":[" + nodes +
                                 "],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"accessors\":[{"
                                 "\"bufferView\":0,\"componentType\":5126,\"count\":" +
                                 count +
                                 ",\"type\":\"VEC3\",\"min\":[-7,-7,-2],\"max\":[7,7,2]}],\"bufferViews\":[{"
                                 "\"buffer\":0,\"byteLength\":" +
                                 length + "}],\"buffers\":[{\"byteLength\":" + length + ",\"uri\":\"many.bin\"}]}");
    EXPECT_EQ(refusal(file), "has too many vertices: must have at most 5000000");
}

}  // namespace
}  // namespace aerogram::planner
