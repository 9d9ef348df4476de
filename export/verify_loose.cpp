#include "export/verify_loose.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "export/bytes/decimal.hpp"
#include "export/bytes/files.hpp"
#include "export/bytes/sha256.hpp"
#include "export/formats.hpp"
#include "export/manifest_json.hpp"
#include "export/verify_agreement.hpp"

namespace aerogram::exporter {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFiles = 100'000;

/// Files that are one show.
struct LooseShow {
    const Format* format = nullptr;
    std::vector<fs::path> paths;
    std::vector<FileBytes> files;
};

/// The manifest of the show folder that a file lies in, when it lists the file.
struct Surrounding {
    Manifest manifest;
    bool same_bytes = false;
};
std::optional<Surrounding> manifest_around(const fs::path& path, const std::string& bytes) {
    std::error_code failure;
    const fs::path file = fs::absolute(path, failure);
    for (const fs::path& folder : {file.parent_path(), file.parent_path().parent_path()}) {
        const auto text = read_file(folder / kManifestName);
        if (!text) continue;
        auto manifest = read_manifest(*text);
        if (!manifest) continue;
        const auto listed =
            std::ranges::find(manifest->files, file.lexically_relative(folder).generic_string(), &ManifestFile::path);
        if (listed == manifest->files.end()) continue;
        const bool same = listed->sha256 == sha256_hex(bytes);
        return Surrounding{std::move(*manifest), same};
    }
    return std::nullopt;
}

/// Findings call drones by their places in the file; people by the numbers in their names, where all have one.
void name_drones(Judgement& judgement, const RecordedShow& show) {
    std::vector<std::size_t> numbers;
    for (const RecordedDrone& drone : show.drones) {
        const std::size_t digits = drone.name.find_last_not_of("0123456789") + 1;
        const auto number = parse_whole(std::string_view(drone.name).substr(digits), 1, 10'000'000);
        if (!number) return;
        numbers.push_back(static_cast<std::size_t>(*number));
    }
    for (Finding& finding : judgement.findings)
        for (std::size_t& drone : finding.drones) drone = numbers[drone - 1];
}

Result<Judgement> verify_show(LooseShow& loose, const Run& run) {
    const std::string name =
        loose.paths.size() == 1 ? loose.paths.front().string() : (loose.paths.front().parent_path() / "").string();
    const auto named = [&](const Error& error) {
        return error.code == ErrorCode::stopped ? error : Error{error.code, name + ": " + error.message};
    };
    const auto around = manifest_around(loose.paths.front(), loose.files.front().bytes);
    if (const Status added = add_companion(*loose.format, loose.paths.front().parent_path(), loose.files); !added)
        return added.error();
    auto show = loose.format->read(loose.files);
    if (!show) return named(show.error());
    if (around) complete_from(around->manifest, *show);
    auto judgement = judge(*show, {}, run);
    if (!judgement) return named(judgement.error());
    if (around) judgement->limits_from = "the manifest beside it";
    if (around && !around->same_bytes)
        judgement->problems.emplace_back("its SHA-256 differs from the manifest beside it");
    if (!show->certified.value_or(true))
        judgement->problems.emplace_back("the file says that this show is not certified");
    if (around && !around->manifest.certified)
        judgement->problems.emplace_back("the manifest beside it says that this show is not certified");
    name_drones(*judgement, *show);
    return judgement;
}

/// Adds a file to the show it belongs to. @param strict  false: a file that is of no format is passed over.
Status add_file(std::vector<LooseShow>& shows, const fs::path& path, bool strict) {
    auto bytes = read_file(path);
    if (!bytes) return bytes.error();
    const std::string name = path.filename().generic_string();
    const Format* format = recognise(name, *bytes);
    if (format == nullptr) {
        if (!strict) return Done{};
        return Error{ErrorCode::invalid_input, path.string() + ": not a format that can be read"};
    }
    const auto same = [&](const LooseShow& show) {
        return format->per_drone && show.format == format && show.paths.front().parent_path() == path.parent_path();
    };
    auto show = std::ranges::find_if(shows, same);
    if (show == shows.end()) show = shows.insert(shows.end(), LooseShow{format, {}, {}});
    show->paths.push_back(path);
    show->files.push_back({name, std::move(*bytes)});
    return Done{};
}

Result<Verified> verify_all(const std::vector<fs::path>& paths, bool strict, const Run& run) {
    std::vector<LooseShow> shows;
    for (const fs::path& path : paths) {
        if (run.stopped()) return stopped_error();
        if (const Status added = add_file(shows, path, strict); !added) return added.error();
    }
    Verified verified;
    for (LooseShow& show : shows) {
        auto judgement = verify_show(show, run);
        if (!judgement) return judgement.error();
        verified.shows.push_back(std::move(*judgement));
        show.files.clear();
    }
    return verified;
}

}  // namespace

Result<Verified> verify_loose(std::span<const fs::path> files, const Run& run) {
    return verify_all({files.begin(), files.end()}, true, run);
}

Result<Verified> verify_loose_folder(const fs::path& folder, const Run& run) {
    std::vector<fs::path> paths;
    std::error_code failure;
    for (fs::recursive_directory_iterator at(folder, failure), end; !failure && at != end; at.increment(failure)) {
        if (!at->is_regular_file(failure) || at->is_symlink(failure)) continue;
        paths.push_back(at->path());
        if (paths.size() > kMostFiles)
            return Error{ErrorCode::invalid_input,
                         folder.string() + ": more than " + std::to_string(kMostFiles) + " files"};
    }
    if (failure) return Error{ErrorCode::io, folder.string() + ": cannot be listed: " + failure.message()};
    std::ranges::sort(paths);
    auto verified = verify_all(paths, false, run);
    if (verified && verified->shows.empty())
        return Error{ErrorCode::invalid_input,
                     folder.string() + ": holds no manifest.json and no file that can be read"};
    return verified;
}

}  // namespace aerogram::exporter
