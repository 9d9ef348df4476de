#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "export/bytes/file_bytes.hpp"
#include "export/outgoing/outgoing_show.hpp"
#include "export/record/recorded_show.hpp"
#include "geo/result.hpp"
#include "geo/run.hpp"

namespace aerogram::exporter {

/// What every writer is given beside the show.
struct Seal {
    std::string show_hash;   ///< 64 hex digits (export/exact/show_hash.hpp); empty: the show has none
    bool certified = false;  ///< false: the writer marks its file as uncertified wherever the format can say so
};

/// What a manifest says of how a file keeps time. @param own  RecordedShow::timing. @param format_timing
/// Format::timing.
[[nodiscard]] inline std::string stated_timing(const std::string& own, std::string_view format_timing, bool claimed) {
    return (own.empty() ? std::string(format_timing) : own) + (claimed ? "" : ": separation not claimed");
}

/// One export format: its writer and its reader side by side. export/formats.hpp lists all.
struct Format {
    std::string_view name;         ///< in --format and the manifest: "skyc"
    std::string_view description;  ///< one line, for help
    std::string_view timing;       ///< "exact", "linear", "none": stated in the manifest
    std::string_view lost;         ///< what a show loses in it, for people: "yaw, payload events and the airspace"
    /// Writes the format's files under `folder`; returns their relative paths in a fixed order. Large files are
    /// streamed: memory beside the show stays below 1 GiB.
    Result<std::vector<std::string>> (*write)(const OutgoingShow&, const Seal&, const std::filesystem::path& folder,
                                              const Run&);
    /// Reads a whole show back from all of the format's files of one folder (usually one file).
    Result<RecordedShow> (*read)(std::span<const FileBytes> files);
    /// True when a file of this name and beginning is likely of this format.
    bool (*recognises)(std::string_view path, std::string_view first_bytes);
    /// Why this show cannot leave in this format ("more than 5,000 drones a file"), or empty.
    std::string (*unsuited)(const OutgoingShow&);
    bool per_drone = false;  ///< a file a drone: only all of them together are a show
};

}  // namespace aerogram::exporter
