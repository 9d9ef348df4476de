#include "export/open_show.hpp"

#include <algorithm>
#include <iterator>
#include <optional>

#include "export/bytes/files.hpp"
#include "export/bytes/sha256.hpp"
#include "export/formats.hpp"
#include "export/verify_folder.hpp"

namespace aerogram::exporter {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFiles = 100'000;

Error invalid(const fs::path& path, const std::string& what) {
    return {ErrorCode::invalid_input, path.string() + ": " + what};
}

std::string known_formats() {
    std::string known;
    for (const Format& each : formats()) known += (known.empty() ? "" : ", ") + std::string(each.name);
    return known;
}

Error unknown(const fs::path& path) {
    return invalid(path, "not a format we read (" + known_formats() + "), nor a mission's file (.toml)");
}

void complete(OpenedShow& opened, const Manifest& manifest, const fs::path& folder) {
    RecordedShow& show = opened.show;
    const bool whole = show.limits && show.airspace && show.origin && show.endurance_s;
    Points pads_m;
    for (const ManifestDrone& drone : manifest.drones) pads_m.push_back(drone.pad_m);
    if (pads_m.size() == show.drones.size()) {
        state_missing_places(show, pads_m);
    } else {
        for (RecordedDrone& drone : show.drones) {
            const auto listed = std::ranges::find(manifest.drones, drone.name, &ManifestDrone::name);
            if (listed == manifest.drones.end()) continue;
            if (!drone.home_m) drone.home_m = listed->pad_m;
            if (!drone.land_m) drone.land_m = listed->pad_m;
        }
    }
    if (whole) return;
    if (!show.limits) show.limits = manifest.limits;
    if (!show.airspace) show.airspace = manifest.airspace;
    if (!show.origin) show.origin = manifest.origin;
    if (!show.endurance_s) show.endurance_s = manifest.endurance_s;
    if (!show.certified)
        show.certified = manifest.certified;  // the hash stays the file's own: its lights may be others
    if (show.title.empty()) show.title = manifest.show_name;
    opened.completed_from = (folder / kManifestName).string();
}

/// The show folder that a file lies in, when its manifest lists the file as it is.
std::optional<std::pair<fs::path, Manifest>> folder_around(const fs::path& path, const std::string& bytes) {
    std::error_code failure;
    const fs::path file = fs::absolute(path, failure).lexically_normal();
    for (const fs::path& folder : {file.parent_path(), file.parent_path().parent_path()}) {
        const auto text = read_file(folder / kManifestName);
        auto manifest = text ? read_manifest(*text) : Result<Manifest>(text.error());
        if (!manifest) continue;
        const auto listed =
            std::ranges::find(manifest->files, file.lexically_relative(folder).generic_string(), &ManifestFile::path);
        if (listed == manifest->files.end() || listed->sha256 != sha256_hex(bytes)) continue;
        return std::pair{folder, std::move(*manifest)};
    }
    return std::nullopt;
}

Result<OpenedShow> open_files(const Format& format, const std::vector<FileBytes>& files, const fs::path& named) {
    auto show = format.read(files);
    if (!show) {
        const std::string& told = show.error().message;
        const bool names_it = told.find(named.filename().string()) != std::string::npos;
        return names_it ? show.error() : Error{show.error().code, named.string() + ": " + told};
    }
    return OpenedShow{std::move(*show), &format, {}, {}};
}

Result<OpenedShow> open_file(const fs::path& path) {
    auto bytes = read_file(path);
    if (!bytes) return bytes.error();
    const std::string name = path.filename().generic_string();
    const Format* format = recognise(name, *bytes);
    if (format == nullptr) return unknown(path);
    const auto around = folder_around(path, *bytes);
    std::vector<FileBytes> files{{name, std::move(*bytes)}};
    if (const Status added = add_companion(*format, path.parent_path(), files); !added) return added.error();
    auto opened = open_files(*format, files, path);
    if (!opened) return opened;
    opened->files = {path};
    if (around) complete(*opened, around->second, around->first);
    return opened;
}

/// The first format that can be read, timed ones before waypoints.
Result<OpenedShow> open_show_folder(const fs::path& folder, const Run& run) {
    const auto listing = list_show_folder(folder);
    if (!listing) return listing.error();
    std::optional<OpenedShow> untimed;
    std::vector<std::string> problems = listing->problems;
    for (const Format& format : formats()) {
        auto own = intact_files(folder, *listing, format.name, run);
        if (!own) return own.error();
        std::ranges::move(own->problems, std::back_inserter(problems));
        if (own->files.empty()) continue;
        auto opened = open_files(format, own->files, folder / own->files.front().path);
        if (run.stopped()) return stopped_error();
        if (!opened) {
            problems.push_back(opened.error().message);
            continue;
        }
        for (const FileBytes& file : own->files) opened->files.push_back(folder / file.path);
        complete(*opened, listing->manifest, folder);
        if (opened->show.timed) return opened;
        if (!untimed) untimed = std::move(*opened);
    }
    if (untimed) return std::move(*untimed);
    return invalid(folder, problems.empty() ? "holds nothing that flies" : problems.front());
}

/// A folder of files of one format.
Result<OpenedShow> open_plain_folder(const fs::path& folder, const Run& run) {
    std::error_code failure;
    std::vector<fs::path> paths;
    for (fs::directory_iterator entry(folder, failure), end; !failure && entry != end; entry.increment(failure)) {
        if (entry->is_regular_file(failure)) paths.push_back(entry->path());
        if (paths.size() > kMostFiles) return invalid(folder, "more than 100000 files");
    }
    if (failure) return Error{ErrorCode::io, folder.string() + ": " + failure.message()};
    std::ranges::sort(paths);
    const Format* format = nullptr;
    std::vector<FileBytes> files;
    std::optional<std::pair<fs::path, Manifest>> around;
    for (const fs::path& path : paths) {
        auto bytes = read_file(path);
        if (!bytes) return bytes.error();
        if (run.stopped()) return stopped_error();
        const Format* own = recognise(path.filename().generic_string(), *bytes);
        if (own == nullptr) return unknown(path);
        if (format != nullptr && own != format) {
            return invalid(path, "is of the format " + std::string(own->name) + ", files before it are " +
                                     std::string(format->name) + ": name one file, or a folder of one format");
        }
        format = own;
        if (files.empty()) around = folder_around(path, *bytes);
        files.push_back({path.filename().generic_string(), std::move(*bytes)});
    }
    if (format == nullptr) return invalid(folder, "holds no files");
    auto opened = open_files(*format, files, folder);
    if (!opened) return opened;
    opened->files = paths;
    if (around) complete(*opened, around->second, around->first);
    return opened;
}

}  // namespace

Result<OpenedShow> open_show(const fs::path& path, const Run& run) {
    std::error_code failure;
    const fs::file_status status = fs::status(path, failure);
    if (!fs::exists(status)) return Error{ErrorCode::io, path.string() + ": does not exist"};
    if (!fs::is_directory(status)) return open_file(path);
    return fs::exists(path / kManifestName, failure) ? open_show_folder(path, run) : open_plain_folder(path, run);
}

}  // namespace aerogram::exporter
