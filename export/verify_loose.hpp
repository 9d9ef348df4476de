#pragma once
#include <filesystem>
#include <span>

#include "export/verify_show.hpp"

namespace aerogram::exporter {

/// Files outside a show folder, also other programs': each file is a show, but for formats with a file a drone, whose
/// files in one folder are one. A manifest in the folder of a file, or in the one above, that lists the file tells its
/// limits, airspace and pads. Errors: io; invalid_input naming a file that is nothing we can read.
Result<Verified> verify_loose(std::span<const std::filesystem::path> files, const Run& run);

/// A folder without a manifest: all of its files, and those of its folders, that are of a format.
/// Errors: as verify_loose; invalid_input when there are none.
Result<Verified> verify_loose_folder(const std::filesystem::path& folder, const Run& run);

}  // namespace aerogram::exporter
