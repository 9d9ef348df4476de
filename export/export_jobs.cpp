#include "export/export_jobs.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

#include "export/bytes/files.hpp"
#include "export/bytes/sha256.hpp"
#include "export/formats.hpp"
#include "export/verify_agreement.hpp"

namespace aerogram::exporter {
namespace {

namespace fs = std::filesystem;

Error invalid(std::string message) {
    return {ErrorCode::invalid_input, std::move(message)};
}

std::string known_names() {
    std::string names;
    for (const Format& format : formats()) names += (names.empty() ? "" : ", ") + std::string(format.name);
    for (const std::string_view paper : kPapers) names += ", " + std::string(paper);
    return names;
}

void write_format(ExportJob& job, const OutgoingShow& show, const Seal& seal, const fs::path& folder, const Run& run) {
    if (run.stopped()) return;
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
/// @param closest  where another format has its smallest separation.
Status check_format(ExportJob& job, const OutgoingFacts& facts, const Seal& seal, const fs::path& folder,
                    const std::optional<LikelyClosest>& closest, const Run& run) {
    if (run.stopped()) return Done{};
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
    std::vector<FileBytes>().swap(files);  // large ones are not needed beside what they say
    const std::string wrong = wrong_identity(*show, facts, seal);
    if (!wrong.empty()) return Error{ErrorCode::io, "what was written as " + job.exported.name + " " + wrong};
    job.exported.rounding = show->rounding;
    state_missing_places(*show, homes_of(facts));
    JudgeAgainst against = judge_against(facts);
    against.likely_closest = closest;
    Result<Judgement> judgement = judge(*show, against, run);
    if (!judgement) return judgement.error();
    job.exported.judgement = std::move(*judgement);
    const bool claimed = job.exported.judgement.separation_claimed;
    job.exported.timing = stated_timing(job.exported.judgement.timing, job.format->timing, claimed);
    for (ManifestFile& file : job.files) {
        file.timing = job.exported.timing;
        if (claimed && facts.drones.size() > 1) file.min_separation_m = job.exported.judgement.min_separation_m;
    }
    return Done{};
}

std::optional<Error> first_error(const std::vector<ExportJob>& jobs, const Run& run) {
    if (run.stopped()) return stopped_error();
    for (const ExportJob& job : jobs) {
        if (job.error) return job.error;
    }
    return std::nullopt;
}

/// The jobs that write, what takes longest first, so that no thread is left with it at the end; but before all others
/// the first in the registry.
std::vector<ExportJob*> in_order(std::vector<ExportJob>& jobs) {
    constexpr std::array<std::string_view, 4> kLongest{"csv", "skyc", "vviz", "preview"};
    std::vector<ExportJob*> order;
    for (ExportJob& job : jobs)
        if (job.exported.skipped.empty()) order.push_back(&job);
    const auto place = [&](const ExportJob* job) {
        return std::ranges::find(kLongest, job->format->name) - kLongest.begin();
    };
    if (!order.empty())
        std::stable_sort(order.begin() + 1, order.end(), [&](auto a, auto b) { return place(a) < place(b); });
    return order;
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

}  // namespace

std::string described(const std::string& format, const Finding& finding) {
    std::string text = format + ": " + finding.rule + " " + worst_and_limit(finding);
    if (!finding.drones.empty()) text += finding.drones.size() == 1 ? ", drone" : ", drones";
    for (const std::size_t drone : finding.drones) text += " " + std::to_string(drone);
    if (finding.time_s) text += ", at " + shown(*finding.time_s) + " s";
    return text;
}

Result<std::vector<ExportJob>> chosen_jobs(const OutgoingShow& show, std::span<const std::string> names,
                                           const Run& run) {
    for (const std::string& name : names) {
        if (find_format(name) == nullptr && !is_paper(name))
            return invalid("no format is named \"" + name + "\"; there are: " + known_names());
    }
    std::vector<ExportJob> jobs;
    for (const Format& format : formats()) {
        if (!names.empty() && std::ranges::find(names, format.name) == names.end()) continue;
        jobs.push_back({&format, {}, {}});
        jobs.back().exported.name = format.name;
    }
    parallel_for(jobs.size(), run, "exporting",
                 [&](std::size_t j) { jobs[j].exported.skipped = jobs[j].format->unsuited(show); });
    if (run.stopped()) return stopped_error();
    for (const ExportJob& job : jobs) {
        if (names.empty() || job.exported.skipped.empty()) continue;
        return invalid("this show cannot leave as " + job.exported.name + ": " + job.exported.skipped);
    }
    return jobs;
}

std::optional<Error> write_and_check(std::vector<ExportJob>& jobs, const OutgoingShow& show, const Seal& seal,
                                     const fs::path& folder, const Run& run) {
    const Run inner{run.stop, {}, run.threads};
    std::optional<LikelyClosest> closest;
    const auto write_and_check_one = [&](ExportJob& job) {
        write_format(job, show, seal, folder, inner);
        if (job.error) return;
        const Status checked = check_format(job, show.facts(), seal, folder, closest, inner);
        if (!checked) job.error = checked.error();
    };
    // The first format is judged alone: where it has its smallest separation the others are looked at first, as verify
    // does it.
    const std::vector<ExportJob*> order = in_order(jobs);
    if (order.empty()) return std::nullopt;
    write_and_check_one(*order.front());
    closest = closest_of(order.front()->exported.judgement);
    parallel_for(order.size() - 1, run, "exporting", [&](std::size_t i) { write_and_check_one(*order[i + 1]); });
    return first_error(jobs, run);
}

void leave_out_broken_waypoints(std::vector<ExportJob>& jobs, std::span<const std::string> asked,
                                const fs::path& folder) {
    for (ExportJob& job : jobs) {
        const Judgement& judgement = job.exported.judgement;
        const bool named = std::ranges::find(asked, job.exported.name) != asked.end();
        if (named || !job.exported.skipped.empty() || judgement.separation_claimed || judgement.held()) continue;
        const auto broken = std::ranges::find(judgement.findings, false, &Finding::held);
        job.exported.skipped =
            "straight legs between its waypoints would break a limit" +
            (broken == judgement.findings.end() ? "" : " (" + described(job.exported.name, *broken) + ")");
        std::error_code ignored;
        for (const std::string& path : job.exported.files) {
            fs::remove(folder / path, ignored);
            fs::remove((folder / path).parent_path(), ignored);  // only once it is empty
        }
        job.exported.files.clear();
        job.files.clear();
        job.exported.rounding = {};
        job.exported.timing.clear();
        job.exported.judgement = {};
    }
}

std::vector<std::string> complaints(const std::vector<ExportJob>& jobs) {
    std::vector<std::string> lines;
    for (const ExportJob& job : jobs) {
        if (!job.exported.skipped.empty() || job.exported.judgement.held()) continue;
        for (const Finding& finding : job.exported.judgement.findings) {
            if (!finding.held) lines.push_back(described(job.exported.name, finding));
        }
        for (const std::string& problem : job.exported.judgement.problems)
            lines.push_back(job.exported.name + ": " + problem);
    }
    return lines;
}

}  // namespace aerogram::exporter
