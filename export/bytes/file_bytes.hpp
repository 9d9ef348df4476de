#pragma once
#include <string>

namespace aerogram::exporter {

/// One file held in memory on its way to or from disk. `path` is relative to the show's folder, with '/'.
struct FileBytes {
    std::string path;
    std::string bytes;
};

}  // namespace aerogram::exporter
