#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "export/outgoing/format.hpp"
#include "export/record/recorded_show.hpp"
#include "geo/result.hpp"
#include "geo/run.hpp"

namespace aerogram::exporter {

/// A show as it was found on disk.
struct OpenedShow {
    RecordedShow show;
    const Format* format = nullptr;
    std::vector<std::filesystem::path> files;  ///< those that were read
    std::string completed_from;  ///< the manifest that told what the files do not hold (limits, origin...); or empty
};

/// Reads a show in any format: a file; a folder of one format's files (one a drone, in the order of their names); or a
/// show folder (manifest.json), of which the first format is taken that can be read, in the registry's order, timed
/// ones first. What the files do not hold is completed from the manifest of the show folder they lie in, when that
/// lists them unchanged. Errors: io; invalid_input naming the file: not a format we read, damaged, a folder of several
/// formats; stopped.
Result<OpenedShow> open_show(const std::filesystem::path& path, const Run& run);

}  // namespace aerogram::exporter
