#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "export/verify/judge.hpp"
#include "geo/result.hpp"
#include "geo/run.hpp"

namespace aerogram::exporter {

struct Verified {
    std::vector<Judgement> shows;       ///< one a format found
    std::vector<std::string> problems;  ///< of the folder: "out/x/show.skyc: SHA-256 differs from the manifest"
    [[nodiscard]] bool held() const;
};
/// A show folder (by its manifest: every file's hash, every format judged, formats compared) or a single file of any
/// format. Errors: io when the path does not exist; invalid_input when it is nothing we can read.
Result<Verified> verify_path(const std::filesystem::path& path, const Run& run);

}  // namespace aerogram::exporter
