#pragma once
#include <string_view>

namespace aerogram::exporter {

/// What wrote a file, as manifests say it. A test holds the version to that of the build.
inline constexpr std::string_view kProgramName = "aerogram";
inline constexpr std::string_view kProgramVersion = "0.1.0";

}  // namespace aerogram::exporter
