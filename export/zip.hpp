#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "export/format.hpp"

namespace aerogram::exporter {

/// A ZIP archive (deflate) of the entries in order, with a fixed date: same entries, same bytes.
/// Errors: invalid_input when there are none.
Result<std::string> zip_bytes(std::span<const FileBytes> entries);

/// The same, written to a file. Errors: as zip_bytes and write_file.
Status write_zip(const std::filesystem::path& file, std::span<const FileBytes> entries);

/// What a reader of untrusted archives may spend.
struct UnzipLimits {
    std::size_t entries = 20'000;
    std::size_t entry_bytes = std::size_t{256} << 20;
    std::size_t total_bytes = std::size_t{4} << 30;
    double ratio = 400.0;  ///< unpacked over packed, of the whole archive above 1 MiB: beyond is a zip bomb
};
/// Entries in archive order. Errors: invalid_input for damaged archives, CRC mismatches, absolute or "../" names,
/// duplicate names, encryption, and anything beyond the limits.
Result<std::vector<FileBytes>> unzip_bytes(std::string_view archive, const UnzipLimits& limits = {});

}  // namespace aerogram::exporter
