#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "export/bytes/file_bytes.hpp"
#include "export/manifest_json.hpp"
#include "geo/run.hpp"

namespace aerogram::exporter {

/// A show folder against its manifest, but for what is in the files.
struct FolderListing {
    Manifest manifest;
    std::vector<std::string> missing;   ///< paths of the manifest that the folder does not hold
    std::vector<std::string> problems;  ///< each names a file: missing, not listed, no plain file
};

/// Errors: io when the folder cannot be listed or its manifest not be read; invalid_input naming manifest.json when it
/// is missing or damaged.
Result<FolderListing> list_show_folder(const std::filesystem::path& folder);

/// The files of one format, each as the manifest has it to the last bit.
struct IntactFiles {
    std::vector<FileBytes> files;       ///< in the manifest's order; empty when one of the format is altered or missing
    std::vector<std::string> problems;  ///< each names an altered file
};
/// Errors: io when a file cannot be read; stopped.
Result<IntactFiles> intact_files(const std::filesystem::path& folder, const FolderListing& listing,
                                 std::string_view format, const Run& run);

}  // namespace aerogram::exporter
