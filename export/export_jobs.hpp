#pragma once
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "export/export_show.hpp"
#include "export/manifest_json.hpp"
#include "export/outgoing/format.hpp"

/// The steps of an export between a plan and a sealed folder, format by format.
namespace aerogram::exporter {

/// A format on its way into the folder.
struct ExportJob {
    const Format* format = nullptr;
    ExportedFormat exported;
    std::vector<ManifestFile> files;  ///< path, bytes and hash as they are on disk
    std::optional<Error> error{};
};

/// The formats to write, in registry order; unsuited ones are kept with the reason unless they were asked for by name.
/// @param names  of formats and papers; empty: all. Errors: invalid_input for unknown and unsuited names; stopped.
Result<std::vector<ExportJob>> chosen_jobs(const OutgoingShow& show, std::span<const std::string> names,
                                           const Run& run);

/// Writes all formats into the folder, several at a time, reads each back, notes its files' hashes and judges what they
/// say. Afterwards no format holds its show in memory. @returns the first error, in registry order.
std::optional<Error> write_and_check(std::vector<ExportJob>& jobs, const OutgoingShow& show, const Seal& seal,
                                     const std::filesystem::path& folder, const Run& run);

/// Untimed waypoints that break a limit between them (a straight leg through an obstacle that the flown curve avoids)
/// are no fault of the plan: unless asked for by name, they are left out with the reason.
void leave_out_broken_waypoints(std::vector<ExportJob>& jobs, std::span<const std::string> asked,
                                const std::filesystem::path& folder);

/// A line for everything that does not hold in the written files; none: all is well.
[[nodiscard]] std::vector<std::string> complaints(const std::vector<ExportJob>& jobs);

}  // namespace aerogram::exporter
