#include "export/verify_show.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>

#include "export/bytes/files.hpp"
#include "export/certificate_json.hpp"
#include "export/formats.hpp"
#include "export/verify_agreement.hpp"
#include "export/verify_folder.hpp"
#include "export/verify_loose.hpp"

namespace aerogram::exporter {
namespace {

namespace fs = std::filesystem;

constexpr double kNumeric = 1e-6;

/// One folder on its way to a verdict.
class FolderCheck {
  public:
    FolderCheck(const fs::path& folder, const FolderListing& listing, const Run& run)
        : folder_(folder), listing_(listing), manifest_(listing.manifest), run_(run) {
        verified_.problems = listing.problems;
    }

    Result<Verified> check() {
        for (const ManifestFile& file : manifest_.files) {
            const auto is_listed = std::ranges::find(manifest_.formats, file.format, &ManifestFormat::name);
            if (is_listed == manifest_.formats.end() && !is_paper(file.format)) {
                problem(file.path, "its format \"" + file.format + "\" is not among the manifest's formats");
            }
        }
        for (const ManifestFormat& format : manifest_.formats) {
            const auto files = load(format.name);
            if (!files) return files.error();
            if (files->empty()) {
                check_absence(format);
            } else if (const Status done = check_format(format, *files); !done) {
                return done.error();
            }
        }
        for (const auto check : {&FolderCheck::check_certificate, &FolderCheck::check_papers}) {
            if (const Status done = (this->*check)(); !done) return done.error();
        }
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

    /// A format's files, intact; what is wrong with others is noted.
    Result<std::vector<FileBytes>> load(std::string_view format) {
        auto loaded = intact_files(folder_, listing_, format, run_);
        if (!loaded) return loaded.error();
        verified_.problems.insert(verified_.problems.end(), loaded->problems.begin(), loaded->problems.end());
        return std::move(loaded->files);
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
        complete_from(manifest_, *show);
        const Status sound = well_formed(*show);
        if (!sound) {
            problem(path, sound.error().message);
            return Done{};
        }
        if (reference_) {
            problems(path, disagreement_of_shows(*reference_, *show, manifest_.limits, manifest_.origin));
            problems(path, disagreement_of_lights(*reference_, *show));
        }
        Status judged = judge_against_manifest(*show, *format, path);
        if (judged && show->timed && !reference_ && !verified_.shows.empty()) {
            reference_ = std::move(*show);
            reference_separation_m_ = verified_.shows.back().min_separation_m;
            reference_closest_ = closest_of(verified_.shows.back());
        }
        return judged;
    }

    Status judge_against_manifest(RecordedShow& show, const Format& format, const std::string& path) {
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
        against.likely_closest = reference_closest_;
        auto judgement = judge(show, against, run_);
        if (!judgement) {
            if (judgement.error().code == ErrorCode::stopped) return judgement.error();
            problem(path, judgement.error().message);
            return Done{};
        }
        judgement->limits_from = kManifestName;
        check_claims(*judgement, format);
        if (reference_ && judgement->separation_claimed) {
            problems(path, disagreement_of_separations(*reference_, reference_separation_m_, show,
                                                       judgement->min_separation_m, manifest_.limits));
        }
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
        const auto files = load("certificate");
        if (!files) return files.error();
        if (files->empty()) {
            const bool listed =
                std::ranges::find(manifest_.files, "certificate", &ManifestFile::format) != manifest_.files.end();
            if (!listed) problem(std::string(kManifestName), "lists no certificate");
            return Done{};
        }
        const std::string& path = files->front().path;
        const auto certificate = read_certificate(files->front().bytes);
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

    /// Report and pad sheet: intact, and the report's claims are the manifest's.
    Status check_papers() {
        for (const std::string_view paper : kPapers) {
            const auto files = load(paper);
            if (!files) return files.error();
            for (const FileBytes& file : *files) problems(file.path, disagreement_of_paper(file, manifest_));
        }
        return Done{};
    }

    const fs::path& folder_;
    const FolderListing& listing_;
    const Manifest& manifest_;
    const Run& run_;
    std::optional<RecordedShow> reference_;  ///< the first timed format: trajectories, where present
    double reference_separation_m_ = 0.0;
    std::optional<LikelyClosest> reference_closest_;
    Verified verified_;
};

Result<Verified> verify_folder(const fs::path& folder, const Run& run) {
    const auto listing = list_show_folder(folder);
    if (!listing) {
        const bool ours = fs::exists(folder / kManifestName) || fs::exists(folder / kCertificateName);
        if (!ours) return verify_loose_folder(folder, run);
        if (listing.error().code != ErrorCode::invalid_input) return listing.error();
        return Verified{{}, {listing.error().message}};  // a show folder that was tampered with
    }
    return FolderCheck(folder, *listing, run).check();
}

}  // namespace

bool Verified::held() const {
    return problems.empty() && std::ranges::all_of(shows, &Judgement::held);
}

Result<Verified> verify_path(const fs::path& path, const Run& run) {
    std::error_code failure;
    const fs::file_status status = fs::status(path, failure);
    if (!fs::exists(status)) return Error{ErrorCode::io, path.string() + ": does not exist"};
    return fs::is_directory(status) ? verify_folder(path, run) : verify_loose({&path, 1}, run);
}

}  // namespace aerogram::exporter
