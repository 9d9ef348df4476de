#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "export/bytes/file_bytes.hpp"
#include "export/manifest_json.hpp"
#include "geo/run.hpp"

namespace aerogram::exporter {

/// A show folder's files as its manifest lists them.
struct FolderFiles {
    Manifest manifest;
    /// Intact files by format, in the manifest's order; a format with an altered or missing file is not here.
    std::map<std::string, std::vector<FileBytes>> by_format;
    std::vector<std::string> problems;  ///< each names a file: altered, missing, not listed, no plain file
};

/// Reads a show folder and checks every file against the manifest, and the folder for files the manifest does not list.
/// Errors: io when the folder cannot be listed or a file not be read; invalid_input naming manifest.json when it is
/// missing or damaged; stopped.
Result<FolderFiles> read_show_folder(const std::filesystem::path& folder, const Run& run);

}  // namespace aerogram::exporter
