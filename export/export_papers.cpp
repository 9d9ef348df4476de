#include "export/export_papers.hpp"

#include <array>
#include <cmath>

#include "export/bytes/files.hpp"
#include "export/exact/show_hash.hpp"
#include "export/exact/trajectories_bin.hpp"
#include "export/outgoing/planned_show.hpp"
#include "export/report/report.hpp"
#include "export/report/report_files.hpp"

namespace aerogram::exporter {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 3> kReportFiles{"report.json", "report.html", "report.pdf"};

ReportFormat reported(const ExportedFormat& format) {
    ReportFormat row;
    row.name = format.name;
    row.timing = format.timing;
    row.skipped = format.skipped;
    row.files = format.files.size();
    if (!format.skipped.empty()) return row;
    if (format.judgement.separation_claimed) row.min_separation_m = format.judgement.min_separation_m;
    row.position_error_m = std::sqrt(3.0) * format.rounding.position_m + format.rounding.fit_m;
    row.problems = format.judgement.problems;
    for (const Finding& finding : format.judgement.findings)
        if (!finding.held) row.problems.push_back(described(format.name, finding));
    row.held = format.judgement.held();
    return row;
}

}  // namespace

Result<Paper> report_paper(const OutgoingShow& show, const Judgement& judgement, const Seal& seal,
                           const std::vector<ExportedFormat>& formats, std::vector<std::string> reasons,
                           const Run& run) {
    ReportInput input{show, judgement, seal.show_hash, seal.certified, std::move(reasons), {}};
    for (const ExportedFormat& format : formats) input.formats.push_back(reported(format));
    const auto report = make_report(input, run);
    if (!report) return report.error();
    auto pdf = report_pdf(*report);
    if (!pdf) return pdf.error();
    Paper paper{"report", {}, report->warnings};
    paper.files.push_back({kReportFiles[0], report_json(*report)});
    paper.files.push_back({kReportFiles[1], report_html(*report)});
    paper.files.push_back({kReportFiles[2], std::move(*pdf)});
    return paper;
}

Result<Paper> pads_paper(const OutgoingShow& show, const Seal& seal) {
    const PadSheet sheet = pad_sheet(show.facts(), seal.show_hash, seal.certified);
    auto pdf = pads_pdf(sheet);
    if (!pdf) return pdf.error();
    return Paper{"pads", {{"pads.csv", pads_csv(sheet)}, {"pads.pdf", std::move(*pdf)}}, {}};
}

std::vector<std::string> reasons_of(const planner::FlightPlan& plan) {
    std::vector<std::string> reasons = plan.certificate.violations;
    for (const planner::ActCertificate& act : plan.certificate.acts)
        reasons.insert(reasons.end(), act.violations.begin(), act.violations.end());
    return reasons;
}

Result<Judgement> judged_exactly(const planner::FlightPlan& plan, const Seal& seal, const Run& run) {
    auto show = read_trajectories(trajectories_bytes(plan, seal, 8));
    if (!show) return show.error();
    return judge(*show, {}, run);
}

fs::path refused_folder(const fs::path& destination) {
    const fs::path named = destination.has_filename() ? destination : destination.parent_path();
    return named.parent_path() / (named.filename().string() + "-refused");
}

Status write_refused_report(const planner::FlightPlan& plan, const fs::path& destination,
                            std::vector<std::string> reasons, const std::vector<ExportedFormat>& formats,
                            const Run& run) {
    const Seal seal{show_hash(plan), false};
    const auto judgement = judged_exactly(plan, seal, run);
    if (!judgement) return judgement.error();
    const auto paper = report_paper(PlannedShow(plan), *judgement, seal, formats, std::move(reasons), run);
    if (!paper) return paper.error();
    for (const FileBytes& file : paper->files) {
        const Status written = replace_file(refused_folder(destination) / file.path, file.bytes);
        if (!written) return written.error();
    }
    return Done{};
}

std::string refused_words(const fs::path& destination) {
    std::string words = "report: " + (refused_folder(destination) / "report.html").string();
    std::error_code failure;
    if (fs::exists(destination / kManifestName, failure))
        words += "\n  " + destination.string() + " still holds the show that was exported there before";
    return words;
}

void remove_refused_report(const fs::path& destination) {
    std::error_code ignored;
    const fs::path folder = refused_folder(destination);
    for (const char* file : kReportFiles) fs::remove(folder / file, ignored);
    fs::remove(folder, ignored);  // only once it is empty
}

}  // namespace aerogram::exporter
