#include "export/verify_folder.hpp"

#include <algorithm>
#include <set>

#include "export/bytes/files.hpp"
#include "export/bytes/sha256.hpp"

namespace aerogram::exporter {
namespace {

namespace fs = std::filesystem;

/// What is in the folder: paths relative to it with '/', folders themselves left out.
struct Listing {
    std::set<std::string> files;
    std::vector<std::string> odd;  ///< links, devices, sockets
};

Result<Listing> list(const fs::path& folder) {
    Listing listing;
    std::error_code failure;
    fs::recursive_directory_iterator at(folder, failure), end;
    for (; !failure && at != end; at.increment(failure)) {
        const std::string path = at->path().lexically_relative(folder).generic_string();
        const fs::file_status status = at->symlink_status(failure);
        if (failure) break;
        if (fs::is_regular_file(status)) {
            listing.files.insert(path);
        } else if (!fs::is_directory(status)) {
            listing.odd.push_back(path);
        }
    }
    if (failure) return Error{ErrorCode::io, folder.string() + ": cannot be listed: " + failure.message()};
    std::ranges::sort(listing.odd);
    return listing;
}

/// What is wrong with a file's bytes, or empty.
std::string alteration(const ManifestFile& listed, const std::string& bytes) {
    if (bytes.size() != listed.bytes) {
        return std::to_string(bytes.size()) + " bytes; the manifest says " + std::to_string(listed.bytes);
    }
    return sha256_hex(bytes) == listed.sha256 ? "" : "SHA-256 differs from the manifest: the file was altered";
}

}  // namespace

Result<FolderFiles> read_show_folder(const fs::path& folder, const Run& run) {
    auto listing = list(folder);
    if (!listing) return listing.error();
    const fs::path manifest_file = folder / kManifestName;
    if (!listing->files.contains(std::string(kManifestName))) {
        return Error{ErrorCode::invalid_input, manifest_file.string() + ": missing: not a show folder"};
    }
    const auto text = read_file(manifest_file);
    if (!text) return text.error();
    auto manifest = read_manifest(*text);
    if (!manifest) return Error{ErrorCode::invalid_input, (folder / manifest.error().message).string()};
    listing->files.erase(std::string(kManifestName));

    FolderFiles result{std::move(*manifest), {}, {}};
    std::set<std::string> broken_formats;
    const auto problem = [&](const std::string& path, const std::string& what) {
        result.problems.push_back((folder / path).string() + ": " + what);
    };
    for (std::size_t i = 0; i < result.manifest.files.size(); ++i) {
        if (run.stopped()) return stopped_error();
        run.report("reading files", static_cast<double>(i) / static_cast<double>(result.manifest.files.size()));
        const ManifestFile& listed = result.manifest.files[i];
        std::string wrong = "missing";
        if (listing->files.erase(listed.path) > 0) {
            auto bytes = read_file(folder / listed.path);
            if (!bytes) return bytes.error();
            wrong = alteration(listed, *bytes);
            if (wrong.empty()) result.by_format[listed.format].push_back({listed.path, std::move(*bytes)});
        }
        if (wrong.empty()) continue;
        problem(listed.path, wrong);
        broken_formats.insert(listed.format);
    }
    for (const std::string& path : listing->files) problem(path, "not listed in the manifest");
    for (const std::string& path : listing->odd) problem(path, "not a plain file");
    for (const std::string& format : broken_formats) result.by_format.erase(format);
    return result;
}

}  // namespace aerogram::exporter
