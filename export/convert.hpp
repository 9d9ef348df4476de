#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "export/convert_compare.hpp"
#include "export/open_show.hpp"
#include "planner/mission/export_wishes.hpp"

/// `aerogram convert`: a show from one format into another (docs/convert.md).
namespace aerogram::exporter {

struct ConvertOptions {
    std::string format;               ///< by name; empty: by the ending of OUT
    std::vector<std::size_t> drones;  ///< only these, by their numbers, rising; empty: all
    std::optional<geo::ShowOrigin> origin;
    planner::ExportWishes exporting;
    bool force = false;  ///< replace a file that is there
};

struct Converted {
    std::string from, format;                  ///< names of formats
    std::vector<std::filesystem::path> files;  ///< written
    std::size_t drones = 0;
    bool timed = true;
    double stated_m = 0.0;               ///< what the format says a position may be off by
    std::optional<Deviation> deviation;  ///< what it is off by; absent: it has no times
    bool certified = false;              ///< as it is marked in the files
    std::string no_longer_certified;     ///< the limit that the new rounding breaks, or empty
    std::string completed_from;          ///< see OpenedShow
    std::vector<std::string> lost, assumed;
};

/// The format of a file to write, by `format` or by its name. Errors: invalid_input naming the formats to choose from.
Result<const Format*> format_for(const std::filesystem::path& out, const std::string& format);

/// Writes IN again in another format: OUT is a file, or a folder for formats of a file a drone (then empty or not yet
/// there). It is written beside OUT, read back, compared with IN at every instant, and moved in place in one step. A
/// show that its file says is certified is judged again as it was written; where it breaks a limit now it is marked as
/// not certified.
/// Errors: invalid_input: IN cannot be read or has no times, the format cannot hold this show (why), OUT is there
/// already, or is IN; infeasible: what was written is farther from IN than the format states; io; stopped. OUT is then
/// as it was.
Result<Converted> convert(const std::filesystem::path& in, const std::filesystem::path& out,
                          const ConvertOptions& options, const Run& run);

}  // namespace aerogram::exporter
