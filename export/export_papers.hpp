#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "export/bytes/file_bytes.hpp"
#include "export/export_show.hpp"
#include "export/outgoing/format.hpp"

/// What is written beside the files that are flown: the flight validation report and the pad sheet.
namespace aerogram::exporter {

/// Files of one kind of paper, as the manifest calls it.
struct Paper {
    std::string name;  ///< "report", "pads" (kPapers)
    std::vector<FileBytes> files;
    std::vector<std::string> warnings{};  ///< Report::warnings
};

/// report.json, report.html and report.pdf.
/// @param judgement  of the whole show's exact trajectories. @param reasons  why the show is not certified.
/// Errors: stopped; io when the PDF library fails.
Result<Paper> report_paper(const OutgoingShow& show, const Judgement& judgement, const Seal& seal,
                           const std::vector<ExportedFormat>& formats, std::vector<std::string> reasons,
                           const Run& run);
/// pads.csv and pads.pdf. Errors: io.
Result<Paper> pads_paper(const OutgoingShow& show, const Seal& seal);

/// Why a plan is not certified, a line each; none: it is.
[[nodiscard]] std::vector<std::string> reasons_of(const planner::FlightPlan& plan);

/// The judgement of a plan's exact trajectories, without files.
Result<Judgement> judged_exactly(const planner::FlightPlan& plan, const Seal& seal, const Run& run);

/// The folder of a refused show's report: "out/x-refused" beside "out/x".
[[nodiscard]] std::filesystem::path refused_folder(const std::filesystem::path& destination);
/// Writes the report of a show that is refused into refused_folder(destination), each file whole or not at all.
/// @param reasons  why it is refused. @param formats  what was written and found to break a limit, if that is why.
/// Errors: io; stopped.
Status write_refused_report(const planner::FlightPlan& plan, const std::filesystem::path& destination,
                            std::vector<std::string> reasons, const std::vector<ExportedFormat>& formats,
                            const Run& run);
/// Where the report of a refused show is, and what lies at its destination, in words.
[[nodiscard]] std::string refused_words(const std::filesystem::path& destination);
/// Takes such a report away again: the show that is there now is not refused. Files of others stay.
void remove_refused_report(const std::filesystem::path& destination);

}  // namespace aerogram::exporter
