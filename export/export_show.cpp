#include "export/export_show.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <numeric>
#include <optional>

#include "export/bytes/files.hpp"
#include "export/bytes/sha256.hpp"
#include "export/certificate_json.hpp"
#include "export/exact/show_hash.hpp"
#include "export/exact/trajectories_bin.hpp"
#include "export/formats.hpp"
#include "export/manifest_json.hpp"
#include "export/outgoing/planned_show.hpp"
#include "export/outgoing/program.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

namespace fs = std::filesystem;

/// A format on its way into the folder.
struct Job {
    const Format* format = nullptr;
    ExportedFormat exported;
    std::vector<ManifestFile> files;  ///< path, bytes and hash as they are on disk
    Rounding rounding;
    std::optional<Error> error;
};

Error invalid(std::string message) {
    return {ErrorCode::invalid_input, std::move(message)};
}

std::string known_names() {
    std::string names;
    for (const Format& format : formats()) names += (names.empty() ? "" : ", ") + std::string(format.name);
    return names;
}

/// The formats to write, in registry order; unsuited ones are kept with the reason unless they were asked for by name.
Result<std::vector<Job>> choose(const OutgoingShow& show, std::span<const std::string> names) {
    for (const std::string& name : names) {
        if (find_format(name) == nullptr)
            return invalid("no format is named \"" + name + "\"; there are: " + known_names());
    }
    std::vector<Job> jobs;
    for (const Format& format : formats()) {
        const bool asked = std::ranges::find(names, format.name) != names.end();
        if (!asked && !names.empty()) continue;
        Job job;
        job.format = &format;
        job.exported.name = format.name;
        job.exported.skipped = format.unsuited(show);
        if (asked && !job.exported.skipped.empty()) {
            return invalid("this show cannot leave as " + job.exported.name + ": " + job.exported.skipped);
        }
        jobs.push_back(std::move(job));
    }
    return jobs;
}

void write_format(Job& job, const OutgoingShow& show, const Seal& seal, const fs::path& folder, const Run& run) {
    if (!job.exported.skipped.empty() || run.stopped()) return;
    Result<std::vector<std::string>> written = job.format->write(show, seal, folder, run);
    if (!written) {
        job.error = written.error();
        return;
    }
    job.exported.files = std::move(*written);
}

Points homes_of(const OutgoingFacts& facts) {
    Points homes_m;
    for (const OutgoingDrone& drone : facts.drones) homes_m.push_back(drone.home_m);
    return homes_m;
}

/// What the file says of itself must be what was written.
std::string wrong_identity(const RecordedShow& read, const OutgoingFacts& facts, const Seal& seal) {
    if (read.show_hash && *read.show_hash != seal.show_hash) return "holds another show hash";
    if (read.certified && *read.certified != seal.certified) return "holds another certified mark";
    if (read.drones.size() != facts.drones.size()) {
        return "holds " + std::to_string(read.drones.size()) + " drones of " + std::to_string(facts.drones.size());
    }
    for (std::size_t i = 0; i < read.drones.size(); ++i) {
        if (read.drones[i].name != facts.drones[i].name) return "names a drone " + read.drones[i].name;
    }
    return {};
}

JudgeAgainst judge_against(const OutgoingFacts& facts) {
    JudgeAgainst against;
    against.limits = facts.limits;
    against.airspace = facts.airspace;
    against.origin = facts.origin;
    against.endurance_s = facts.endurance_s;
    against.limits_from = kManifestName;
    return against;
}

/// Reads a format's files from disk, notes their hashes, and judges what they say.
Status check_format(Job& job, const OutgoingFacts& facts, const Seal& seal, const fs::path& folder, const Run& run) {
    if (!job.exported.skipped.empty() || run.stopped()) return Done{};
    std::vector<FileBytes> files;
    job.files.clear();
    for (const std::string& path : job.exported.files) {
        Result<std::string> bytes = read_file(folder / path);
        if (!bytes) return bytes.error();
        job.files.push_back({path, job.exported.name, bytes->size(), sha256_hex(*bytes), std::nullopt, std::nullopt});
        files.push_back({path, std::move(*bytes)});
    }
    Result<RecordedShow> show = job.format->read(files);
    if (!show) return Error{ErrorCode::io, "what was written cannot be read back: " + show.error().message};
    const std::string wrong = wrong_identity(*show, facts, seal);
    if (!wrong.empty()) return Error{ErrorCode::io, "what was written as " + job.exported.name + " " + wrong};
    job.rounding = show->rounding;
    state_missing_places(*show, homes_of(facts));
    Result<Judgement> judgement = judge(*show, judge_against(facts), run);
    if (!judgement) return judgement.error();
    job.exported.judgement = std::move(*judgement);
    for (ManifestFile& file : job.files) {
        const bool claimed = job.exported.judgement.separation_claimed;
        file.timing = stated_timing(job.exported.judgement.timing, job.format->timing, claimed);
        if (claimed && facts.drones.size() > 1) file.min_separation_m = job.exported.judgement.min_separation_m;
    }
    return Done{};
}

std::optional<Error> first_error(const std::vector<Job>& jobs, const Run& run) {
    if (run.stopped()) return stopped_error();
    for (const Job& job : jobs) {
        if (job.error) return job.error;
    }
    return std::nullopt;
}

/// Places in `jobs`, what takes longest first, so that no thread is left with it at the end.
std::vector<std::size_t> longest_first(const std::vector<Job>& jobs) {
    constexpr std::array<std::string_view, 4> kLongest{"csv", "skyc", "trajectories", "preview"};
    std::vector<std::size_t> places(jobs.size());
    std::iota(places.begin(), places.end(), std::size_t{0});
    std::ranges::stable_sort(places, {}, [&](std::size_t i) {
        return std::ranges::find(kLongest, jobs[i].format->name) - kLongest.begin();
    });
    return places;
}

/// Writes and checks all formats, several at a time; their order in the result is fixed.
std::optional<Error> write_and_check(std::vector<Job>& jobs, const OutgoingShow& show, const Seal& seal,
                                     const fs::path& folder, const Run& run) {
    const Run inner{run.stop, {}, run.threads};
    const std::vector<std::size_t> order = longest_first(jobs);
    parallel_for(jobs.size(), run, "exporting", [&](std::size_t i) {
        Job& job = jobs[order[i]];
        write_format(job, show, seal, folder, inner);
        if (job.error) return;
        const Status checked = check_format(job, show.facts(), seal, folder, inner);
        if (!checked) job.error = checked.error();
    });
    return first_error(jobs, run);
}

constexpr int kDigits = 4, kMostDigits = 17;

std::string shown(double value, int digits = kDigits) {
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), "%.*g", digits, value);
    return text.data();
}

/// "120.0011, limit 120": with as many digits as it takes to tell them apart.
std::string worst_and_limit(const Finding& finding) {
    int digits = kDigits;
    while (digits < kMostDigits && shown(finding.worst, digits) == shown(finding.limit, digits)) ++digits;
    return shown(finding.worst, digits) + ", limit " + shown(finding.limit, digits);
}

std::string describe(const std::string& format, const Finding& finding) {
    std::string text = format + ": " + finding.rule + " " + worst_and_limit(finding);
    if (!finding.drones.empty()) text += finding.drones.size() == 1 ? ", drone" : ", drones";
    for (const std::size_t drone : finding.drones) text += " " + std::to_string(drone);
    if (finding.time_s) text += ", at " + shown(*finding.time_s) + " s";
    return text;
}

/// One line for everything that does not hold in the written files; empty: all is well.
std::string complaints(const std::vector<Job>& jobs) {
    std::string text;
    const auto add = [&](const std::string& line) { text += (text.empty() ? "" : "\n") + line; };
    for (const Job& job : jobs) {
        if (!job.exported.skipped.empty() || job.exported.judgement.held()) continue;
        for (const Finding& finding : job.exported.judgement.findings) {
            if (!finding.held) add(describe(job.exported.name, finding));
        }
        for (const std::string& problem : job.exported.judgement.problems) add(job.exported.name + ": " + problem);
    }
    return text;
}

Manifest manifest_of(const std::vector<Job>& jobs, const OutgoingShow& show, const Seal& seal,
                     const std::string& certificate) {
    const OutgoingFacts& facts = show.facts();
    Manifest m;
    m.program = kProgramName;
    m.version = kProgramVersion;
    m.show_name = facts.title;
    m.show_hash = seal.show_hash;
    m.certified = seal.certified;
    m.duration_s = seconds_from_ms(facts.duration_ms);
    m.origin = *facts.origin;
    m.limits = facts.limits;
    m.endurance_s = facts.endurance_s;
    m.airspace = facts.airspace;
    for (const Job& job : jobs) {
        m.formats.push_back({job.exported.name, job.exported.skipped, job.rounding});
        m.files.insert(m.files.end(), job.files.begin(), job.files.end());
    }
    m.files.push_back({std::string(kCertificateName), "certificate", certificate.size(), sha256_hex(certificate),
                       std::nullopt, std::nullopt});
    for (const OutgoingDrone& drone : facts.drones) m.drones.push_back({drone.name, drone.home_m});
    return m;
}

/// Replacing a folder deletes what is in it: only a show of ours with nothing else in it may be replaced.
Status check_replaceable(const fs::path& destination) {
    std::error_code failure;
    if (!fs::is_directory(destination, failure) || fs::is_empty(destination, failure)) return Done{};
    const auto keep = [&](const std::string& why) {
        return invalid(destination.string() + ": " + why + "; name another folder, or remove it");
    };
    const Result<std::string> bytes = read_file(destination / kManifestName);
    const Result<Manifest> manifest = bytes ? read_manifest(*bytes) : Result<Manifest>(bytes.error());
    if (!manifest) return keep("exists and is no show folder written by aerogram");
    for (fs::recursive_directory_iterator entry(destination, failure), end; !failure && entry != end;
         entry.increment(failure)) {
        if (entry->is_directory(failure) && !entry->is_symlink(failure)) continue;
        const std::string path = entry->path().lexically_relative(destination).generic_string();
        const bool ours = path == kManifestName ||
                          std::ranges::find(manifest->files, path, &ManifestFile::path) != manifest->files.end();
        if (!ours) return keep("holds " + path + ", which aerogram did not write");
    }
    if (failure) return Error{ErrorCode::io, destination.string() + ": " + failure.message()};
    return Done{};
}

/// Untimed waypoints that break a limit between them (a straight leg through an obstacle that the flown curve avoids)
/// are no fault of the plan: unless asked for by name, they are left out with the reason.
void leave_out_broken_waypoints(std::vector<Job>& jobs, std::span<const std::string> asked, const fs::path& folder) {
    for (Job& job : jobs) {
        const Judgement& judgement = job.exported.judgement;
        const bool named = std::ranges::find(asked, job.exported.name) != asked.end();
        if (named || !job.exported.skipped.empty() || judgement.separation_claimed || judgement.held()) continue;
        const auto broken = std::ranges::find(judgement.findings, false, &Finding::held);
        job.exported.skipped =
            "straight legs between its waypoints would break a limit" +
            (broken == judgement.findings.end() ? "" : " (" + describe(job.exported.name, *broken) + ")");
        std::error_code ignored;
        for (const std::string& path : job.exported.files) {
            fs::remove(folder / path, ignored);
            fs::remove((folder / path).parent_path(), ignored);  // only once it is empty
        }
        job.exported.files.clear();
        job.files.clear();
        job.rounding = {};
        job.exported.judgement = {};
    }
}

/// Certificate and manifest, the manifest last; then the swap.
Status seal_folder(StagedFolder& folder, const std::vector<Job>& jobs, const planner::FlightPlan& plan,
                   const OutgoingShow& show, const Seal& seal, const Run& run) {
    run.report("sealing", 0.0);
    const std::string certificate = certificate_json(plan, seal.show_hash, seal.certified);
    Status done = write_file(folder.path() / kCertificateName, certificate);
    if (!done) return done;
    done = write_file(folder.path() / kManifestName, manifest_json(manifest_of(jobs, show, seal, certificate)));
    if (!done) return done;
    if (run.stopped()) return stopped_error();
    done = folder.commit();
    if (done) run.report("sealing", 1.0);
    return done;
}

}  // namespace

Result<ExportedShow> export_show(const planner::FlightPlan& plan, const fs::path& destination,
                                 const ExportOptions& options, const Run& run) {
    const std::string unsuited = trajectories_unsuited(plan);
    if (!unsuited.empty()) return invalid("this show cannot be exported: " + unsuited);
    const PlannedShow show = options.drones.empty() ? PlannedShow(plan) : PlannedShow(plan, options.drones);
    Result<std::vector<Job>> jobs = choose(show, options.formats);
    if (!jobs) return jobs.error();
    Seal seal{show_hash(plan), plan.certificate.certified()};
    if (!seal.certified && !options.best_effort) return Error{ErrorCode::infeasible, "the plan is not certified"};
    if (const Status replaceable = check_replaceable(destination); !replaceable) return replaceable.error();
    Result<StagedFolder> folder = StagedFolder::beside(destination);
    if (!folder) return folder.error();

    if (const auto error = write_and_check(*jobs, show, seal, folder->path(), run)) return *error;
    if (seal.certified) leave_out_broken_waypoints(*jobs, options.formats, folder->path());
    const std::string wrong = complaints(*jobs);
    if (!wrong.empty() && !options.best_effort) {
        return Error{ErrorCode::infeasible, "the written files break limits that the plan holds:\n" + wrong};
    }
    if (!wrong.empty() && seal.certified) {  // the files must say so: write them again
        seal.certified = false;
        if (const auto error = write_and_check(*jobs, show, seal, folder->path(), run)) return *error;
    }
    const Status sealed = seal_folder(*folder, *jobs, plan, show, seal, run);
    if (!sealed) return sealed.error();
    ExportedShow result{seal.show_hash, seal.certified, {}};
    for (Job& job : *jobs) result.formats.push_back(std::move(job.exported));
    return result;
}

}  // namespace aerogram::exporter
