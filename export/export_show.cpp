#include "export/export_show.hpp"

#include <algorithm>
#include <optional>

#include "export/bytes/files.hpp"
#include "export/bytes/sha256.hpp"
#include "export/certificate_json.hpp"
#include "export/exact/show_hash.hpp"
#include "export/exact/trajectories_bin.hpp"
#include "export/export_jobs.hpp"
#include "export/export_papers.hpp"
#include "export/manifest_json.hpp"
#include "export/outgoing/planned_show.hpp"
#include "export/outgoing/program.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

namespace fs = std::filesystem;

Error invalid(std::string message) {
    return {ErrorCode::invalid_input, std::move(message)};
}

/// A file that belongs to no format.
ManifestFile listed(const std::string& name, const FileBytes& file) {
    return {file.path, name, file.bytes.size(), sha256_hex(file.bytes), std::nullopt, std::nullopt};
}

Manifest manifest_of(const std::vector<ExportJob>& jobs, const OutgoingShow& show, const Seal& seal,
                     const std::vector<Paper>& papers) {
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
    for (const ExportJob& job : jobs) {
        m.formats.push_back({job.exported.name, job.exported.skipped, job.exported.rounding});
        m.files.insert(m.files.end(), job.files.begin(), job.files.end());
    }
    for (const Paper& paper : papers) {
        for (const FileBytes& file : paper.files) m.files.push_back(listed(paper.name, file));
    }
    m.fleet = facts.fleet;
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

bool wanted(const ExportOptions& options, std::string_view paper) {
    return options.formats.empty() || std::ranges::find(options.formats, paper) != options.formats.end();
}

/// Certificate, report and pad sheet. The report is of the whole show's exact trajectories, so a part of a fleet has
/// none.
Result<std::vector<Paper>> papers_of(const planner::FlightPlan& plan, const OutgoingShow& show, const Seal& seal,
                                     const std::vector<ExportJob>& jobs, const ExportOptions& options, const Run& run) {
    std::vector<Paper> papers;
    const std::string certificate = certificate_json(plan, seal.show_hash, seal.certified);
    papers.push_back({"certificate", {{std::string(kCertificateName), certificate}}, {}});
    if (wanted(options, "pads")) {
        auto pads = pads_paper(show, seal);
        if (!pads) return pads.error();
        papers.push_back(std::move(*pads));
    }
    if (!wanted(options, "report") || show.whole_plan() == nullptr) return papers;
    run.report("report", 0.0);
    std::vector<ExportedFormat> formats;
    for (const ExportJob& job : jobs) formats.push_back(job.exported);
    const auto exact = std::ranges::find(formats, "trajectories", &ExportedFormat::name);
    const auto judgement =
        exact != formats.end() ? Result<Judgement>(exact->judgement) : judged_exactly(plan, seal, run);
    if (!judgement) return judgement.error();
    std::vector<std::string> reasons = reasons_of(plan);
    for (std::string& line : complaints(jobs)) reasons.push_back(std::move(line));
    auto report = report_paper(show, *judgement, seal, formats, std::move(reasons), run);
    if (!report) return report.error();
    papers.push_back(std::move(*report));
    return papers;
}

/// Papers and manifest, the manifest last; then the swap.
Status seal_folder(StagedFolder& folder, const std::vector<ExportJob>& jobs, const OutgoingShow& show, const Seal& seal,
                   const std::vector<Paper>& papers, const Run& run) {
    run.report("sealing", 0.0);
    for (const Paper& paper : papers) {
        for (const FileBytes& file : paper.files) {
            if (const Status done = write_file(folder.path() / file.path, file.bytes); !done) return done;
        }
    }
    Status done = write_file(folder.path() / kManifestName, manifest_json(manifest_of(jobs, show, seal, papers)));
    if (!done) return done;
    if (run.stopped()) return stopped_error();
    done = folder.commit();
    if (done) run.report("sealing", 1.0);
    return done;
}

/// The refusal, with a report beside where the show would have gone.
Error refused(const planner::FlightPlan& plan, const fs::path& destination, const std::string& why,
              const std::vector<ExportJob>& jobs, const Run& run) {
    const std::vector<std::string> lines = complaints(jobs);
    std::vector<std::string> reasons = reasons_of(plan);
    reasons.insert(reasons.end(), lines.begin(), lines.end());
    std::vector<ExportedFormat> formats;
    for (const ExportJob& job : jobs) formats.push_back(job.exported);
    const Status told = write_refused_report(plan, destination, reasons, formats, run);
    if (!told) return told.error();
    std::string message = why;
    for (const std::string& line : lines) message += "\n" + line;
    return {ErrorCode::infeasible, message + "\n  " + refused_words(destination)};
}

}  // namespace

Result<ExportedShow> export_show(const planner::FlightPlan& plan, const fs::path& destination,
                                 const ExportOptions& options, const Run& run) {
    const std::string unsuited = trajectories_unsuited(plan);
    if (!unsuited.empty()) return invalid("this show cannot be exported: " + unsuited);
    if (!options.drones.empty() && std::ranges::find(options.formats, "report") != options.formats.end())
        return invalid("report: is of the whole show; leave out the drones");
    const PlannedShow show = options.drones.empty() ? PlannedShow(plan) : PlannedShow(plan, options.drones);
    Result<std::vector<ExportJob>> jobs = chosen_jobs(show, options.formats, run);
    if (!jobs) return jobs.error();
    Seal seal{show_hash(plan), plan.certificate.certified()};
    if (!seal.certified && !options.best_effort)
        return refused(plan, destination, "the plan is not certified", {}, run);
    if (const Status replaceable = check_replaceable(destination); !replaceable) return replaceable.error();
    Result<StagedFolder> folder = StagedFolder::beside(destination);
    if (!folder) return folder.error();

    if (const auto error = write_and_check(*jobs, show, seal, folder->path(), run)) return *error;
    if (seal.certified) leave_out_broken_waypoints(*jobs, options.formats, folder->path());
    const std::vector<std::string> wrong = complaints(*jobs);
    if (!wrong.empty() && !options.best_effort)
        return refused(plan, destination, "the written files break limits that the plan holds:", *jobs, run);
    if (!wrong.empty() && seal.certified) {  // the files must say so: write them again
        seal.certified = false;
        if (const auto error = write_and_check(*jobs, show, seal, folder->path(), run)) return *error;
    }
    const auto papers = papers_of(plan, show, seal, *jobs, options, run);
    if (!papers) return papers.error();
    const Status sealed = seal_folder(*folder, *jobs, show, seal, *papers, run);
    if (!sealed) return sealed.error();
    remove_refused_report(destination);
    ExportedShow result{seal.show_hash, seal.certified, {}, {}, wrong};
    for (const Paper& paper : *papers)
        result.warnings.insert(result.warnings.end(), paper.warnings.begin(), paper.warnings.end());
    for (ExportJob& job : *jobs) result.formats.push_back(std::move(job.exported));
    return result;
}

}  // namespace aerogram::exporter
