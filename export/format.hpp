#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "export/record/recorded_show.hpp"
#include "geo/result.hpp"
#include "geo/run.hpp"
#include "planner/motion/flight_plan.hpp"

namespace aerogram::exporter {

/// What every writer is given beside the plan.
struct Seal {
    std::string show_hash;   ///< 64 hex digits (export/show_hash.hpp)
    bool certified = false;  ///< false: the writer marks its file as uncertified wherever the format can say so
};

/// One file held in memory on its way to or from disk. `path` is relative to the show's folder, with '/'.
struct FileBytes {
    std::string path;
    std::string bytes;
};

/// One export format: its writer and its reader side by side. The registry below is the list of all.
struct Format {
    std::string_view name;         ///< in --format and the manifest: "skyc"
    std::string_view description;  ///< one line, for help
    std::string_view timing;       ///< "exact", "linear", "none": stated in the manifest
    /// Writes the format's files under `folder`; returns their relative paths in a fixed order.
    Result<std::vector<std::string>> (*write)(const planner::FlightPlan&, const Seal&,
                                              const std::filesystem::path& folder, const Run&);
    /// Reads a whole show back from all of the format's files of one folder (usually one file).
    Result<RecordedShow> (*read)(std::span<const FileBytes> files);
    /// True when a file of this name and beginning is likely of this format.
    bool (*recognises)(std::string_view path, std::string_view first_bytes);
    /// Why this plan cannot leave in this format ("more than 5,000 drones a file"), or empty.
    std::string (*unsuited)(const planner::FlightPlan&);
};

/// All formats, in the order they are written.
std::span<const Format> formats();
const Format* find_format(std::string_view name);
/// The format of a file by name and content, or null.
const Format* recognise(std::string_view path, std::string_view bytes);

/// "drone-001": the drone's stable name in every file; as many digits as the fleet needs, at least three.
std::string drone_name(std::size_t number, std::size_t fleet);

}  // namespace aerogram::exporter
