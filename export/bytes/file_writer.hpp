#pragma once
#include <filesystem>
#include <string_view>

#include "export/bytes/descriptor.hpp"
#include "geo/result.hpp"

namespace aerogram::exporter {

/// A file that is written piece by piece, for formats too large to be held in memory. What was appended before an error
/// stays: write into folders that are thrown away then (StagedFolder).
class FileWriter {
  public:
    /// Creates or empties the file, folders included. Errors: io.
    static Result<FileWriter> create(const std::filesystem::path& file);

    /// Errors: io; those of earlier calls again.
    Status append(std::string_view bytes);
    /// Ends the file. Errors: io, when anything could not be kept.
    Status close();

  private:
    FileWriter(std::filesystem::path file, Descriptor fd) : file_(std::move(file)), fd_(std::move(fd)) {}

    std::filesystem::path file_;
    Descriptor fd_;
    bool broken_ = false;
};

}  // namespace aerogram::exporter
