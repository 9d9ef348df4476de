#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "geo/result.hpp"

namespace aerogram::exporter {

/// The file that says what is in a show's folder; a folder with it is one of ours.
inline constexpr std::string_view kManifestName = "manifest.json";

/// A whole file as bytes. Errors: io, naming the file. @param limit  bytes; larger files are refused (invalid_input).
Result<std::string> read_file(const std::filesystem::path& file, std::uintmax_t limit = std::uintmax_t{8} << 30);
/// Creates or replaces a file, folders included. Errors: io.
Status write_file(const std::filesystem::path& file, std::string_view bytes);
/// Creates or replaces a file in one step, folders included, links followed: whoever reads it, also after a failure or
/// a kill -9, finds the old bytes or the new ones, complete. Errors: io; what was there is then as it was.
Status replace_file(const std::filesystem::path& file, std::string_view bytes);

/// A folder being written beside its destination; `commit` swaps it in with renameat2(RENAME_EXCHANGE), so that a
/// reader, or whoever comes after a kill -9, finds the old folder or the new one, complete. Uncommitted folders are
/// removed; leftovers of killed runs are removed by the next one that writes the same destination. A staging folder is
/// locked (flock) while its process lives: such folders are nobody's leftovers.
class StagedFolder {
  public:
    /// Errors: io when the parent cannot be written, invalid_input when the destination exists and is no folder of ours
    /// (it has no manifest.json and is not empty).
    static Result<StagedFolder> beside(const std::filesystem::path& destination);
    StagedFolder(StagedFolder&&) noexcept;
    StagedFolder& operator=(StagedFolder&&) noexcept;
    ~StagedFolder();

    [[nodiscard]] const std::filesystem::path& path() const { return staging_; }
    /// Flushes to disk and swaps. Errors: io; the destination is then as it was.
    Status commit();

  private:
    StagedFolder() = default;
    void discard() noexcept;

    std::filesystem::path staging_, destination_;
    int lock_ = -1;  ///< descriptor of the locked staging folder
};

}  // namespace aerogram::exporter
