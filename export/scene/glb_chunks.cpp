#include "export/scene/glb_chunks.hpp"

#include <algorithm>
#include <cstring>

#include "export/bytes/little_endian.hpp"

namespace aerogram::exporter {
namespace {

constexpr std::size_t kLargestJson = std::size_t{64} << 20U;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinChunk = 0x004E4942;
constexpr std::int64_t kMost = std::int64_t{1} << 33;
constexpr std::int64_t kFloat = 5126;

std::size_t whole(const JsonNode& node, std::string_view key) {
    const auto found = node.find(key);
    return found ? static_cast<std::size_t>(found->whole(0, kMost)) : 0;
}

}  // namespace

Result<GlbChunks> glb_chunks(std::string_view bytes) {
    ByteCursor cursor(bytes, 0);
    if (cursor.bytes(4) != "glTF")
        cursor.complain("must be glTF: this is no GLB file", std::min<std::size_t>(4, bytes.size()));
    if (cursor.number<std::uint32_t>() != 2) cursor.complain("version must be 2", 4);
    const auto total = cursor.number<std::uint32_t>();
    if (cursor.ok() && total != bytes.size()) cursor.complain("the length is not the file's", 4);
    GlbChunks chunks;
    for (std::size_t k = 0; cursor.ok() && cursor.left() > 0; ++k) {
        const auto length = cursor.number<std::uint32_t>();
        const auto kind = cursor.number<std::uint32_t>();
        if (k == 0 && kind != kJsonChunk) cursor.complain("the first chunk must be JSON", 4);
        if (k == 0 && length > kLargestJson) cursor.complain("a JSON chunk above 64 MiB", 8);
        const std::string_view body = cursor.bytes(length);
        if (k == 0) chunks.json = body;
        if (k == 1 && kind == kBinChunk) chunks.bin = body;
    }
    if (cursor.ok() && chunks.json.empty()) cursor.complain("has no JSON chunk");
    if (!cursor.ok()) return Error{ErrorCode::invalid_input, cursor.problem()};
    return chunks;
}

std::string_view glb_view(const JsonNode& root, std::string_view bin, std::size_t view) {
    const JsonNode node = root["bufferViews"].at(view);
    const std::int64_t buffer = node["buffer"].whole(0, kMost);
    if (buffer != 0 || root["buffers"].at(0).find("uri")) node.fail("only the file's own binary chunk can be read");
    const std::size_t offset = whole(node, "byteOffset"), length = whole(node, "byteLength");
    if (offset > bin.size() || length > bin.size() - offset) node.fail("reaches beyond the binary chunk");
    return root.problem().found() ? std::string_view{} : bin.substr(offset, length);
}

GlbNumbers::GlbNumbers(const JsonNode& root, std::string_view bin, std::size_t accessor, std::string_view type) {
    const JsonNode node = root["accessors"].at(accessor);
    if (node["type"].text() != type) node.fail("must be of type " + std::string(type));
    if (node["componentType"].whole(0, kMost) != kFloat) node.fail("must be of floats, componentType 5126");
    if (node.find("sparse")) node.fail("sparse accessors cannot be read");
    const std::size_t width = type == "VEC3" ? 12 : 4;
    const auto view = static_cast<std::size_t>(node["bufferView"].whole(0, kMost));
    const std::string_view bytes = glb_view(root, bin, view);
    const std::size_t count = whole(node, "count"), offset = whole(node, "byteOffset");
    if (root.problem().found()) return;
    const auto stride = root["bufferViews"].at(view).find("byteStride");
    stride_ = stride ? static_cast<std::size_t>(stride->whole(4, 252)) : width;
    if (stride_ < width) node.fail("has a stride below its width");
    const bool inside = count > 0 && offset <= bytes.size() && bytes.size() - offset >= width &&
                        (bytes.size() - offset - width) / std::max<std::size_t>(stride_, 1) >= count - 1;
    if (!inside) node.fail("is empty or reaches beyond its buffer view");
    if (root.problem().found()) return;
    bytes_ = bytes.substr(offset);
    count_ = count;
}

double GlbNumbers::at(std::size_t element, std::size_t component) const {
    float value = 0.0F;
    std::memcpy(&value, bytes_.data() + element * stride_ + component * sizeof(float), sizeof(float));
    return static_cast<double>(value);
}

}  // namespace aerogram::exporter
