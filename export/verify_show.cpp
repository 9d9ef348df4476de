#include "export/verify_show.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>

#include "export/bytes/files.hpp"
#include "export/bytes/sha256.hpp"
#include "export/certificate_json.hpp"
#include "export/formats.hpp"
#include "export/verify_agreement.hpp"
#include "export/verify_folder.hpp"

namespace aerogram::exporter {
namespace {

namespace fs = std::filesystem;

constexpr double kNumeric = 1e-6;

Error named(const std::string& place, const Error& error) {
    return {error.code, place + ": " + error.message};
}

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

void take_pads(RecordedShow& show, const Manifest& manifest) {
    Points pads_m;
    for (const ManifestDrone& drone : manifest.drones) pads_m.push_back(drone.pad_m);
    state_missing_places(show, pads_m);
}

void take_limits(RecordedShow& show, const Manifest& manifest) {
    show.limits = manifest.limits;
    show.airspace = manifest.airspace;
    show.origin = manifest.origin;
    show.endurance_s = manifest.endurance_s;
}

Result<Verified> verify_file(const fs::path& path, const Run& run) {
    auto bytes = read_file(path);
    if (!bytes) return bytes.error();
    const std::string name = path.filename().generic_string();
    const Format* format = recognise(name, *bytes);
    if (format == nullptr) return Error{ErrorCode::invalid_input, path.string() + ": not a format that can be read"};
    const auto around = manifest_around(path, *bytes);
    const std::array files{FileBytes{name, std::move(*bytes)}};
    auto show = format->read(files);
    if (!show) return named(path.string(), show.error());
    if (around) {
        take_limits(*show, around->manifest);
        take_pads(*show, around->manifest);
    }
    auto judgement = judge(*show, {}, run);
    if (!judgement)
        return judgement.error().code == ErrorCode::stopped ? judgement.error()
                                                            : named(path.string(), judgement.error());
    if (around) judgement->limits_from = "the manifest beside it";
    if (around && !around->same_bytes)
        judgement->problems.emplace_back("its SHA-256 differs from the manifest beside it");
    if (!show->certified.value_or(true))
        judgement->problems.emplace_back("the file says that this show is not certified");
    return Verified{{std::move(*judgement)}, {}};
}

/// One folder on its way to a verdict.
class FolderCheck {
  public:
    FolderCheck(const fs::path& folder, const FolderFiles& files, const Run& run)
        : folder_(folder), manifest_(files.manifest), files_(files), run_(run) {
        verified_.problems = files.problems;
    }

    Result<Verified> check() {
        for (const ManifestFile& file : manifest_.files) {
            const auto is_listed = std::ranges::find(manifest_.formats, file.format, &ManifestFormat::name);
            if (is_listed == manifest_.formats.end() && file.format != "certificate") {
                problem(file.path, "its format \"" + file.format + "\" is not among the manifest's formats");
            }
        }
        for (const ManifestFormat& format : manifest_.formats) {
            const auto files = files_.by_format.find(format.name);
            if (files == files_.by_format.end()) {
                check_absence(format);
            } else if (const Status done = check_format(format, files->second); !done) {
                return done.error();
            }
        }
        if (const Status done = check_certificate(); !done) return done.error();
        if (verified_.shows.empty() && verified_.problems.empty())
            problem(std::string(kManifestName), "lists nothing that flies");
        if (!manifest_.certified) problem(std::string(kManifestName), "says that this show is not certified");
        if (run_.stopped()) return stopped_error();
        return std::move(verified_);
    }

  private:
    void problem(const std::string& path, const std::string& what) {
        verified_.problems.push_back((folder_ / path).string() + ": " + what);
    }
    void problems(const std::string& path, const Problems& all) {
        for (const std::string& what : all) problem(path, what);
    }

    /// A written format must have files; altered and missing ones were named already.
    void check_absence(const ManifestFormat& format) {
        const bool listed =
            std::ranges::find(manifest_.files, format.name, &ManifestFile::format) != manifest_.files.end();
        if (format.skipped.empty() && !listed) problem(std::string(kManifestName), "no file of format " + format.name);
        if (!format.skipped.empty() && listed)
            problem(std::string(kManifestName), "files of the skipped format " + format.name);
    }

    Status check_format(const ManifestFormat& listed, const std::vector<FileBytes>& files) {
        const std::string& path = files.front().path;
        const Format* format = find_format(listed.name);
        if (format == nullptr) {
            problem(path, "format \"" + listed.name + "\" is not known to this program");
            return Done{};
        }
        auto show = format->read(files);
        if (!show) {
            problem(path, show.error().message);
            return Done{};
        }
        problems(path, disagreement_with_manifest(*show, manifest_));
        take_pads(*show, manifest_);
        const Status sound = well_formed(*show);
        if (!sound) {
            problem(path, sound.error().message);
            return Done{};
        }
        if (reference_) {
            problems(path, disagreement_of_shows(*reference_, *show, manifest_.limits, manifest_.origin));
        }
        Status judged = judge_against_manifest(*show, *format, path);
        if (judged && show->timed && !reference_) reference_ = std::move(*show);
        return judged;
    }

    Status judge_against_manifest(RecordedShow show, const Format& format, const std::string& path) {
        take_limits(show, manifest_);
        const geo::ShowFrame frame(manifest_.origin);
        for (std::size_t d = 0; d < std::min(show.drones.size(), manifest_.drones.size()); ++d) {
            RecordedDrone& drone = show.drones[d];
            if (drone.home) drone.home->height_m = frame.to_geodetic(manifest_.drones[d].pad_m).height_m;
        }
        JudgeAgainst against;
        for (const ManifestFile& file : manifest_.files) {
            if (file.format == format.name && file.min_separation_m)
                against.claimed_separation_m = file.min_separation_m;
        }
        auto judgement = judge(show, against, run_);
        if (!judgement) {
            if (judgement.error().code == ErrorCode::stopped) return judgement.error();
            problem(path, judgement.error().message);
            return Done{};
        }
        judgement->limits_from = kManifestName;
        check_claims(*judgement, format);
        verified_.shows.push_back(std::move(*judgement));
        return Done{};
    }

    /// What the manifest says of each file of a format.
    void check_claims(const Judgement& found, const Format& format) {
        const std::string timing = stated_timing(found.timing, format.timing, found.separation_claimed);
        for (const ManifestFile& file : manifest_.files) {
            if (file.format != format.name) continue;
            if (file.timing != timing)
                problem(file.path, "the manifest does not give its timing as \"" + timing + "\"");
            if (!file.min_separation_m) continue;
            if (!found.separation_claimed || *file.min_separation_m > found.min_separation_m + kNumeric) {
                std::array<char, 160> text{};
                std::snprintf(text.data(), text.size(), "the manifest claims a separation of %.6f m; %.6f m was found",
                              *file.min_separation_m, found.separation_claimed ? found.min_separation_m : 0.0);
                problem(file.path, text.data());
            }
        }
    }

    Status check_certificate() {
        const auto files = files_.by_format.find("certificate");
        if (files == files_.by_format.end()) {
            const bool listed =
                std::ranges::find(manifest_.files, "certificate", &ManifestFile::format) != manifest_.files.end();
            if (!listed) problem(std::string(kManifestName), "lists no certificate");
            return Done{};
        }
        const std::string& path = files->second.front().path;
        const auto certificate = read_certificate(files->second.front().bytes);
        if (!certificate) {
            problem(path, certificate.error().message);
            return Done{};
        }
        if (!reference_ || reference_->format != "trajectories") return Done{};
        const auto found = disagreement_with_certificate(*certificate, manifest_, *reference_, run_);
        if (!found) return found.error();
        problems(path, *found);
        return Done{};
    }

    const fs::path& folder_;
    const Manifest& manifest_;
    const FolderFiles& files_;
    const Run& run_;
    std::optional<RecordedShow> reference_;  ///< the first timed format: trajectories, where present
    Verified verified_;
};

Result<Verified> verify_folder(const fs::path& folder, const Run& run) {
    const auto files = read_show_folder(folder, run);
    if (!files) {
        const bool ours = fs::exists(folder / kManifestName) || fs::exists(folder / kCertificateName);
        if (!ours || files.error().code != ErrorCode::invalid_input) return files.error();
        return Verified{{}, {files.error().message}};  // a show folder that was tampered with
    }
    return FolderCheck(folder, *files, run).check();
}

}  // namespace

bool Verified::held() const {
    return problems.empty() && std::ranges::all_of(shows, &Judgement::held);
}

Result<Verified> verify_path(const fs::path& path, const Run& run) {
    std::error_code failure;
    const fs::file_status status = fs::status(path, failure);
    if (!fs::exists(status)) return Error{ErrorCode::io, path.string() + ": does not exist"};
    return fs::is_directory(status) ? verify_folder(path, run) : verify_file(path, run);
}

}  // namespace aerogram::exporter
