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
    Judgement judgement;  ///< of the written files, read back
};
struct ExportedShow {
    std::string show_hash;
    bool certified = false;
    std::vector<ExportedFormat> formats;
};

/// Writes the plan in the named formats (empty: all suited ones), certificate.json and manifest.json into
/// `destination`, reads every file back, judges it (verify), and swaps the folder in atomically. Errors: infeasible
/// when a written file breaks a limit and best_effort is off; invalid_input for unknown or unsuited formats asked for
/// by name; io; stopped. On any error the destination is as it was.
Result<ExportedShow> export_show(const planner::FlightPlan& plan, const std::filesystem::path& destination,
                                 std::span<const std::string> format_names, bool best_effort, const Run& run);

}  // namespace aerogram::exporter
