#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "export/outgoing/format.hpp"
#include "export/verify/judge.hpp"

namespace aerogram::exporter {

struct ExportedFormat {
    std::string name;
    std::vector<std::string> files;
    std::string skipped;  ///< why it was left out, or empty
    std::string timing;   ///< as the manifest says it
    Rounding rounding;
    Judgement judgement;  ///< of the written files, read back
};
/// "csv: separation 1.2, limit 1.5, drones 3 4, at 12.5 s".
[[nodiscard]] std::string described(const std::string& format, const Finding& finding);

struct ExportedShow {
    std::string show_hash;
    bool certified = false;
    std::vector<ExportedFormat> formats;
    std::vector<std::string> warnings;  ///< what the report warns of
    std::vector<std::string> broken;    ///< limits that written files break (best_effort)
};

struct ExportOptions {
    std::vector<std::string> formats;  ///< by name, "report" and "pads" too; empty: all that suit
    bool best_effort = false;          ///< export even what is not certified, marked so in every file
    std::vector<DroneId> drones;       ///< only these, rising; empty: the whole fleet
};

/// Writes the plan in the named formats (empty: all suited ones), certificate.json and manifest.json into
/// `destination`, reads every file back, judges it (verify), adds report and pad sheet, and swaps the folder in
/// atomically. Errors: infeasible when the plan or a written file breaks a limit and best_effort is off: its report is
/// then in refused_folder(destination) (export/export_papers.hpp); invalid_input for unknown or unsuited formats asked
/// for by name; io; stopped. On any error the destination is as it was.
Result<ExportedShow> export_show(const planner::FlightPlan& plan, const std::filesystem::path& destination,
                                 const ExportOptions& options, const Run& run);

}  // namespace aerogram::exporter
