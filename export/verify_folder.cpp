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

Result<FolderListing> list_show_folder(const fs::path& folder) {
    auto found = list(folder);
    if (!found) return found.error();
    const fs::path manifest_file = folder / kManifestName;
    if (found->files.erase(std::string(kManifestName)) == 0) {
        return Error{ErrorCode::invalid_input, manifest_file.string() + ": missing: not a show folder"};
    }
    const auto text = read_file(manifest_file);
    if (!text) return text.error();
    auto manifest = read_manifest(*text);
    if (!manifest) return Error{ErrorCode::invalid_input, (folder / manifest.error().message).string()};

    FolderListing listing{std::move(*manifest), {}, {}};
    const auto problem = [&](const std::string& path, const std::string& what) {
        listing.problems.push_back((folder / path).string() + ": " + what);
    };
    for (const ManifestFile& file : listing.manifest.files) {
        if (found->files.erase(file.path) > 0) continue;
        listing.missing.push_back(file.path);
        problem(file.path, "missing");
    }
    for (const std::string& path : found->files) problem(path, "not listed in the manifest");
    for (const std::string& path : found->odd) problem(path, "not a plain file");
    return listing;
}

Result<IntactFiles> intact_files(const fs::path& folder, const FolderListing& listing, std::string_view format,
                                 const Run& run) {
    IntactFiles result;
    bool complete = true;
    for (const ManifestFile& file : listing.manifest.files) {
        if (file.format != format) continue;
        if (run.stopped()) return stopped_error();
        if (std::ranges::find(listing.missing, file.path) != listing.missing.end()) {
            complete = false;
            continue;
        }
        auto bytes = read_file(folder / file.path);
        if (!bytes) return bytes.error();
        const std::string wrong = alteration(file, *bytes);
        if (wrong.empty()) {
            result.files.push_back({file.path, std::move(*bytes)});
        } else {
            complete = false;
            result.problems.push_back((folder / file.path).string() + ": " + wrong);
        }
    }
    if (!complete) result.files.clear();
    return result;
}

}  // namespace aerogram::exporter
