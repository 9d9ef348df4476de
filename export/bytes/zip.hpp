#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "export/bytes/file_bytes.hpp"
#include "geo/result.hpp"

namespace aerogram::exporter {

/// An entry ready for an archive: packed apart from the others, so that threads can pack many.
struct PackedEntry {
    std::string path;
    std::string packed;  ///< deflate stream
    std::uint32_t size = 0, crc = 0;
};
/// @param bytes  below 4 GiB
[[nodiscard]] PackedEntry packed_entry(std::string path, std::string_view bytes);

/// A ZIP archive (deflate) of the entries in order, with a fixed date: same entries, same bytes.
/// Errors: invalid_input when there are none, more than 65,534, or 4 GiB of them (ZIP64 is not written).
Result<std::string> zip_archive(std::span<const PackedEntry> entries);
Result<std::string> zip_bytes(std::span<const FileBytes> entries);

/// The same, written to a file. Errors: as zip_archive and write_file.
Status write_zip(const std::filesystem::path& file, std::span<const PackedEntry> entries);

/// What a reader of untrusted archives may spend.
struct UnzipLimits {
    std::size_t entries = 20'000;
    std::size_t entry_bytes = std::size_t{256} << 20;
    std::size_t total_bytes = std::size_t{4} << 30;
    double ratio = 400.0;  ///< unpacked over packed, of the whole archive above 1 MiB: beyond is a zip bomb
};

/// An archive whose entries are unpacked one by one.
class ZipArchive {
  public:
    /// @param archive  must outlive this. Errors: invalid_input for damaged archives, absolute or "../" names,
    /// duplicate names, encryption, and anything beyond the limits.
    static Result<ZipArchive> open(std::string_view archive, const UnzipLimits& limits = {});
    ZipArchive(ZipArchive&&) noexcept;
    ZipArchive& operator=(ZipArchive&&) noexcept;
    ~ZipArchive();

    /// Entries in archive order, folders left out.
    [[nodiscard]] std::size_t size() const;
    [[nodiscard]] const std::string& path(std::size_t entry) const;
    /// Safe from several threads. Errors: invalid_input for damaged entries and CRC mismatches.
    [[nodiscard]] Result<std::string> unpacked(std::size_t entry) const;

  private:
    struct Impl;
    explicit ZipArchive(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

/// All entries at once. Errors: as ZipArchive.
Result<std::vector<FileBytes>> unzip_bytes(std::string_view archive, const UnzipLimits& limits = {});

}  // namespace aerogram::exporter
