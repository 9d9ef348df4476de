#include "export/skybrush/skyc_archive.hpp"

#include <algorithm>
#include <charconv>

#include "export/bytes/decimal.hpp"
#include "export/bytes/zip.hpp"

namespace aerogram::exporter {
namespace {

constexpr std::size_t kLargestEntry = std::size_t{96} << 20, kMostEntries = 65'534;

/// "drones/a/x.json" of folder "drones/a/" and "./x.json"; empty when it leads out of the archive.
std::string joined(std::string folder, std::string_view path) {
    Fields steps(path, '/');
    while (const auto step = steps.next()) {
        if (step->empty() || *step == ".") continue;
        if (*step == "..") {
            if (folder.empty()) return {};
            folder.pop_back();
            folder.erase(folder.rfind('/') == std::string::npos ? 0 : folder.rfind('/') + 1);
        } else {
            folder += std::string(*step) + '/';
        }
    }
    if (!folder.empty()) folder.pop_back();
    return folder;
}

/// "a b" of "a%20b".
std::string percent_decoded(std::string_view text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        unsigned byte = 0;
        const char* const digits = text.data() + i + 1;
        const bool escaped =
            text[i] == '%' && text.size() - i > 2 && std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2;
        out += escaped ? static_cast<char>(byte) : text[i];
        if (escaped) i += 2;
    }
    return out;
}

}  // namespace

Result<SkycArchive> SkycArchive::open(const FileBytes& file) {
    UnzipLimits limits;
    limits.entry_bytes = kLargestEntry;
    limits.entries = kMostEntries;
    const auto refused = [&](const Error& error) { return Error{error.code, file.path + ": " + error.message}; };
    const auto entries = ZipArchive::open(file.bytes, limits);
    if (!entries) return refused(entries.error());
    SkycArchive archive;
    archive.name_ = file.path;
    archive.problem_ = std::make_unique<JsonProblem>();
    archive.nothing_ = std::make_unique<JsonDocument>(JsonDocument::parse(file.path, "null").value());
    for (std::size_t i = 0; i < entries->size(); ++i) {
        const std::string& path = entries->path(i);
        if (!path.ends_with(".json")) {
            archive.others_.insert(path);
            continue;
        }
        auto text = entries->unpacked(i);
        if (!text) return refused(text.error());
        archive.texts_.emplace(path, std::move(*text));
    }
    if (!archive.texts_.contains("show.json"))
        return Error{ErrorCode::invalid_input, file.path + ": holds no show.json"};
    return archive;
}

const JsonDocument* SkycArchive::parsed(const std::string& entry) {
    if (const auto known = documents_.find(entry); known != documents_.end()) return &known->second;
    const auto text = texts_.find(entry);
    if (text == texts_.end()) return nullptr;
    auto document = JsonDocument::parse(name_ + ": " + entry, text->second);
    if (!document && !problem_->found()) problem_->text = document.error().message;
    if (!document) return nullptr;
    const bool again = !parsed_once_.insert(entry).second;
    if (passing_ && !again) {
        passed_.push_back(entry);
    } else {
        std::string().swap(text->second);
    }
    return &documents_.emplace(entry, std::move(*document)).first->second;
}

void SkycArchive::next_drone() {
    for (const std::string& entry : passed_) documents_.erase(entry);
    passed_.clear();
    passing_ = true;
}

JsonNode SkycArchive::document(const std::string& entry) {
    const JsonDocument* found = parsed(entry);
    if (found == nullptr && !problem_->found()) problem_->text = name_ + ": holds no " + entry;
    return (found == nullptr ? *nothing_ : *found).root(*problem_);
}

/// The entry that a reference of a node leads to: as it is spelt, else with "%20" and the like decoded.
std::string SkycArchive::entry_of(const JsonNode& holder, std::string_view reference) const {
    const std::string_view path = reference.substr(0, reference.find('#'));
    std::string entry = holder.file() == name_ ? "" : holder.file().substr(name_.size() + 2);
    if (path.empty()) return entry;
    const std::size_t slash = entry.rfind('/');
    const std::string folder = path.starts_with('/') ? "" : entry.substr(0, slash == std::string::npos ? 0 : slash + 1);
    std::string as_spelt = joined(folder, path);
    return holds(as_spelt) ? as_spelt : joined(folder, percent_decoded(path));
}

bool SkycArchive::holds(const std::string& entry) const {
    return texts_.contains(entry) || others_.contains(entry);
}

bool SkycArchive::holds_target(const JsonNode& node) const {
    const auto reference = node.is_object() ? node.find("$ref") : std::nullopt;
    return !reference || holds(entry_of(node, reference->text()));
}

std::optional<std::string_view> SkycArchive::unparsed(const JsonNode& node) const {
    const auto reference = node.is_object() ? node.find("$ref") : std::nullopt;
    if (!reference) return std::nullopt;
    const std::string place = reference->text();
    if (place.empty() || place.find('#') != place.size() - 1) return std::nullopt;
    const std::string entry = entry_of(node, place);
    const auto text = texts_.find(entry);
    if (text == texts_.end() || documents_.contains(entry)) return std::nullopt;
    return text->second;
}

JsonNode SkycArchive::target(const JsonNode& holder, const std::string& reference) {
    const std::size_t hash = std::min(reference.find('#'), reference.size());
    const std::string_view pointer = std::string_view(reference).substr(std::min(hash + 1, reference.size()));
    const std::string entry = entry_of(holder, reference);
    const JsonDocument* found = parsed(entry);
    if (found == nullptr) {
        holder.fail("$ref " + shown(reference) + ": no such entry");
        return nothing_->root(*problem_);
    }
    return found->pointed(percent_decoded(pointer), *problem_);
}

JsonNode SkycArchive::resolved(JsonNode node) {
    for (int hop = 0; node.is_object(); ++hop) {
        const auto reference = node.find("$ref");
        if (!reference) return node;
        if (hop == kMostHops) {
            node.fail("$ref: more than " + std::to_string(kMostHops) + " references after one another");
            return nothing_->root(*problem_);
        }
        node = target(node, reference->text());
    }
    return node;
}

}  // namespace aerogram::exporter
