#include "planner/mesh/scene_assimp.hpp"

#include <assimp/BaseImporter.h>
#include <assimp/GltfMaterial.h>
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/DefaultLogger.hpp>
#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <assimp/LogStream.hpp>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <string_view>
#include <system_error>

namespace aerogram::planner {
namespace {

namespace fs = std::filesystem;

class MemoryStream : public Assimp::IOStream {
  public:
    explicit MemoryStream(std::string bytes) : bytes_(std::move(bytes)) {}

    std::size_t Read(void* into, std::size_t size, std::size_t count) override {
        const std::size_t got = size == 0 ? 0 : std::min(count, (bytes_.size() - at_) / size);
        if (got > 0) std::memcpy(into, bytes_.data() + at_, got * size);
        at_ += got * size;
        return got;
    }
    std::size_t Write(const void*, std::size_t, std::size_t) override { return 0; }
    aiReturn Seek(std::size_t offset, aiOrigin origin) override {
        const std::size_t base = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? at_ : bytes_.size();
        const std::size_t target = origin == aiOrigin_END ? base - offset : base + offset;
        if (target > bytes_.size()) return aiReturn_FAILURE;
        at_ = target;
        return aiReturn_SUCCESS;
    }
    std::size_t Tell() const override { return at_; }
    std::size_t FileSize() const override { return bytes_.size(); }
    void Flush() override {}

  private:
    std::string bytes_;
    std::size_t at_ = 0;
};

/// Files in one folder and below it, to be read; what was asked for elsewhere is remembered.
class FolderFiles : public Assimp::IOSystem {
  public:
    explicit FolderFiles(const fs::path& file) : folder_(fs::weakly_canonical(fs::absolute(file).parent_path())) {}

    bool Exists(const char* name) const override {
        std::error_code error;
        const fs::path path = inside(name);
        return !path.empty() && fs::is_regular_file(path, error);
    }
    char getOsSeparator() const override { return '/'; }
    Assimp::IOStream* Open(const char* name, const char* mode) override {
        const fs::path path = inside(name);
        std::error_code error;
        if (path.empty() || std::string_view(mode).find_first_of("wa+") != std::string_view::npos) return nullptr;
        if (!fs::is_regular_file(path, error) || fs::file_size(path, error) > kLargestMeshFile) return nullptr;
        std::ifstream in(path, std::ios::binary);
        if (!in) return nullptr;
        return new MemoryStream(std::string{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()});
    }
    void Close(Assimp::IOStream* stream) override { delete stream; }

    [[nodiscard]] const std::string& elsewhere() const { return elsewhere_; }

  private:
    /// Empty when the name leads out of the folder (by "..", a link, or an address).
    [[nodiscard]] fs::path inside(std::string_view name) const {
        std::error_code error;
        const fs::path path = fs::weakly_canonical(folder_ / fs::path(name), error);
        const auto [end, rest] = std::mismatch(folder_.begin(), folder_.end(), path.begin(), path.end());
        const bool address = name.find("://") != std::string_view::npos;
        if (!error && !address && end == folder_.end()) return path;
        if (elsewhere_.empty()) elsewhere_ = name;
        return {};
    }

    fs::path folder_;
    mutable std::string elsewhere_;
};

/// What the importer leaves out instead of failing.
class Complaints : public Assimp::LogStream {
  public:
    explicit Complaints(bool& left_out) : left_out_(left_out) {}
    void write(const char* message) override {
        if (std::string_view(message).find("out-of-range indices") != std::string_view::npos) left_out_ = true;
    }

  private:
    bool& left_out_;
};

/// Everything but the kinds we promise is taken out of the importer.
void keep_only_our_kinds(Assimp::Importer& importer) {
    for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
        const aiImporterDesc* about = importer.GetImporterInfo(i);
        const std::string_view kinds = about == nullptr ? "" : about->mFileExtensions;
        const bool old = about != nullptr && std::string_view(about->mName) == "glTF Importer";  // of version 1
        if ((kinds == "obj" || kinds == "stl" || kinds == "ply" || kinds == "gltf glb") && !old) continue;
        importer.UnregisterLoader(importer.GetImporter(i));
    }
}

Vec3 ours(const aiVector3D& v) {
    return {v.x, v.y, v.z};
}
glm::dquat ours(const aiQuaternion& q) {
    return {q.w, q.x, q.y, q.z};
}
glm::dmat4 ours(const aiMatrix4x4& m) {
    glm::dmat4 out(1.0);
    for (unsigned row = 0; row < 4; ++row)
        for (unsigned column = 0; column < 4; ++column)
            out[static_cast<int>(column)][static_cast<int>(row)] = m[row][column];
    return out;
}

double linear_from_srgb(double v) {
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);  // IEC 61966-2-1
}

/// @param linear  the numbers are linear light already.
Rgb ours(const aiColor4D& c, bool linear) {
    const auto light = [&](double v) {
        const double share = v >= 0.0 ? std::min(v, 1.0) : 0.0;  // what is no number is dark
        return linear ? share : linear_from_srgb(share);
    };
    return {light(c.r), light(c.g), light(c.b)};
}

enum class Kind { gltf, obj, other };

void add_colors(ScenePart& part, const aiMesh& mesh, const aiScene& scene, Kind kind) {
    const bool linear = kind == Kind::gltf;
    const bool by_vertex = mesh.HasVertexColors(0);
    Rgb base{1.0, 1.0, 1.0};
    aiColor4D color;
    aiString name;
    if (kind != Kind::other && mesh.mMaterialIndex < scene.mNumMaterials) {
        const aiMaterial& material = *scene.mMaterials[mesh.mMaterialIndex];
        const bool named = material.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS;
        const bool said = kind == Kind::gltf ? material.Get(AI_MATKEY_BASE_COLOR, color) == aiReturn_SUCCESS
                                             : material.Get(AI_MATKEY_COLOR_DIFFUSE, color) == aiReturn_SUCCESS;
        // What the importer makes up: an OBJ's material has its own name, a glTF's is white and has none.
        const bool own = kind == Kind::obj ? std::string_view(name.C_Str()) != AI_DEFAULT_MATERIAL_NAME
                                           : named || ours(color, linear) != base;
        if (own && said && (linear || !by_vertex)) {
            base = ours(color, linear);
            part.colored = true;
        }
    }
    part.mesh.colors.assign(part.mesh.vertices.size(), base);
    if (!by_vertex) return;
    part.colored = true;
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
        const Rgb c = ours(mesh.mColors[0][i], linear);
        part.mesh.colors[i] = {c.r * base.r, c.g * base.g, c.b * base.b};
    }
}

using NodeNumbers = std::map<std::string, std::uint32_t, std::less<>>;

ScenePart part_of(const aiMesh& mesh, const aiScene& scene, const NodeNumbers& nodes, Kind kind) {
    ScenePart part;
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) part.mesh.vertices.push_back(ours(mesh.mVertices[i]));
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
        const aiFace& face = mesh.mFaces[f];
        if (face.mNumIndices != 3) continue;  // points and lines
        const std::array<std::uint32_t, 3> corners{face.mIndices[0], face.mIndices[1], face.mIndices[2]};
        if (*std::max_element(corners.begin(), corners.end()) >= mesh.mNumVertices)
            throw Error{ErrorCode::invalid_input, "is damaged: a triangle names a vertex that is not there"};
        part.mesh.triangles.push_back(corners);
    }
    add_colors(part, mesh, scene, kind);
    for (unsigned k = 0; k < mesh.mNumAnimMeshes; ++k) {
        const aiAnimMesh& target = *mesh.mAnimMeshes[k];
        Points places = part.mesh.vertices;
        if (target.mNumVertices == mesh.mNumVertices && target.mVertices != nullptr)
            for (unsigned i = 0; i < mesh.mNumVertices; ++i) places[i] = ours(target.mVertices[i]);
        part.targets.push_back(std::move(places));
        part.target_weights.push_back(target.mWeight);
    }
    for (unsigned b = 0; b < mesh.mNumBones; ++b) {
        const aiBone& bone = *mesh.mBones[b];
        const auto node = nodes.find(std::string_view(bone.mName.C_Str()));
        if (node == nodes.end()) throw Error{ErrorCode::invalid_input, "is damaged: a bone is no part of the scene"};
        SceneBone ours_bone{node->second, ours(bone.mOffsetMatrix), {}};
        for (unsigned w = 0; w < bone.mNumWeights; ++w) {
            const aiVertexWeight& weight = bone.mWeights[w];
            if (weight.mVertexId < mesh.mNumVertices && weight.mWeight > 0.0F)
                ours_bone.weights.emplace_back(weight.mVertexId, weight.mWeight);
        }
        part.bones.push_back(std::move(ours_bone));
    }
    return part;
}

/// The tree as a list, parents first.
void add_nodes(Scene& scene, NodeNumbers& numbers, const aiNode& root) {
    std::vector<std::pair<const aiNode*, std::uint32_t>> next{{&root, 0}};
    while (!next.empty()) {
        const auto [node, parent] = next.back();
        next.pop_back();
        const auto number = static_cast<std::uint32_t>(scene.nodes.size());
        numbers.try_emplace(node->mName.C_Str(), number);
        SceneNode ours_node{parent, ours(node->mTransformation), {}};
        for (unsigned m = 0; m < node->mNumMeshes; ++m) ours_node.parts.push_back(node->mMeshes[m]);
        scene.nodes.push_back(std::move(ours_node));
        for (unsigned c = node->mNumChildren; c-- > 0;) next.emplace_back(node->mChildren[c], number);
    }
}

template <class T>
void tidy(std::vector<SceneKey<T>>& keys, SceneClip& clip) {
    std::erase_if(keys, [](const SceneKey<T>& k) { return !std::isfinite(k.time); });
    std::stable_sort(keys.begin(), keys.end(),
                     [](const SceneKey<T>& a, const SceneKey<T>& b) { return a.time < b.time; });
    if (keys.size() < 2) return;  // a constant, which the importer dates 0
    clip.begin = std::min(clip.begin, keys.front().time);
    clip.end = std::max(clip.end, keys.back().time);
}

SceneClip clip_of(const aiAnimation& animation, const NodeNumbers& nodes) {
    SceneClip clip{animation.mName.C_Str(), {}, {}, HUGE_VAL, -HUGE_VAL};
    for (unsigned c = 0; c < animation.mNumChannels; ++c) {
        const aiNodeAnim& channel = *animation.mChannels[c];
        const auto node = nodes.find(std::string_view(channel.mNodeName.C_Str()));
        if (node == nodes.end()) continue;
        NodeTrack track{node->second, {}, {}, {}};
        for (unsigned k = 0; k < channel.mNumPositionKeys; ++k)
            track.moves.push_back({channel.mPositionKeys[k].mTime, ours(channel.mPositionKeys[k].mValue)});
        for (unsigned k = 0; k < channel.mNumScalingKeys; ++k)
            track.scales.push_back({channel.mScalingKeys[k].mTime, ours(channel.mScalingKeys[k].mValue)});
        for (unsigned k = 0; k < channel.mNumRotationKeys; ++k)
            track.turns.push_back({channel.mRotationKeys[k].mTime, ours(channel.mRotationKeys[k].mValue)});
        tidy(track.moves, clip);
        tidy(track.scales, clip);
        tidy(track.turns, clip);
        clip.nodes.push_back(std::move(track));
    }
    for (unsigned c = 0; c < animation.mNumMorphMeshChannels; ++c) {
        const aiMeshMorphAnim& channel = *animation.mMorphMeshChannels[c];
        const auto node = nodes.find(std::string_view(channel.mName.C_Str()));
        if (node == nodes.end()) continue;
        WeightTrack track{node->second, {}};
        for (unsigned k = 0; k < channel.mNumKeys; ++k) {
            const aiMeshMorphKey& key = channel.mKeys[k];
            std::vector<double> weights;
            for (unsigned w = 0; w < key.mNumValuesAndWeights; ++w) {
                const std::size_t target = key.mValues[w];
                if (target >= 10'000) continue;
                if (target >= weights.size()) weights.resize(target + 1, 0.0);
                weights[target] = key.mWeights[w];
            }
            track.weights.push_back({key.mTime, std::move(weights)});
        }
        tidy(track.weights, clip);
        clip.morphs.push_back(std::move(track));
    }
    if (clip.begin > clip.end) clip.begin = clip.end = 0.0;
    return clip;
}

Scene converted(const aiScene& from, Kind kind) {
    Scene scene;
    NodeNumbers numbers;
    add_nodes(scene, numbers, *from.mRootNode);
    for (unsigned m = 0; m < from.mNumMeshes; ++m)
        scene.parts.push_back(part_of(*from.mMeshes[m], from, numbers, kind));
    for (const SceneNode& node : scene.nodes)
        for (const std::uint32_t part : node.parts)
            if (part >= scene.parts.size())
                throw Error{ErrorCode::invalid_input, "is damaged: a node names a mesh that is not there"};
    for (unsigned a = 0; a < from.mNumAnimations; ++a) scene.clips.push_back(clip_of(*from.mAnimations[a], numbers));
    return scene;
}

Kind kind_of(const fs::path& file) {
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    if (ending == ".gltf" || ending == ".glb") return Kind::gltf;
    return ending == ".obj" ? Kind::obj : Kind::other;
}

/// The importer's message, fit for ours.
std::string one_line(std::string text) {
    if (text == "std::bad_alloc") return "it asks for more memory than there may be";
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c >= 0 && c < ' '; }, ' ');
    return text.substr(0, 200);
}

}  // namespace

Result<Scene> read_scene(const fs::path& file) {
    try {
        Assimp::Importer importer;
        bool left_out = false;
        Assimp::DefaultLogger::create("", Assimp::Logger::NORMAL, 0);
        Assimp::DefaultLogger::get()->attachStream(new Complaints(left_out), Assimp::Logger::Warn);
        auto* files = new FolderFiles(file);  // the importer's from here on
        importer.SetIOHandler(files);
        keep_only_our_kinds(importer);
        const aiScene* scene = importer.ReadFile(file.filename().string(), aiProcess_Triangulate);
        if (!files->elsewhere().empty())
            return Error{ErrorCode::invalid_input,
                         "names \"" + one_line(files->elsewhere()) + "\": only files in its own folder are opened"};
        if (scene == nullptr || scene->mRootNode == nullptr)
            return Error{ErrorCode::invalid_input, "is damaged: " + one_line(importer.GetErrorString())};
        if (left_out) return Error{ErrorCode::invalid_input, "is damaged: a triangle names a vertex that is not there"};
        return converted(*scene, kind_of(file));
    } catch (const Error& error) {
        return error;
    }
}

}  // namespace aerogram::planner
