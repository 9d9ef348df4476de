#pragma once
#include <filesystem>
#include <string_view>

#include "geo/result.hpp"
#include "planner/mission/mission.hpp"

namespace aerogram::planner {

/// Reads and checks a mission file (TOML 1.0; MISSION.md is the schema).
/// Errors: invalid_input with every problem found, one a line, `file:line: key = value: what would be accepted`;
/// unknown keys suggest the nearest known one; keys and values of later versions are refused as "not in this version".
/// io when the file cannot be read.
Result<Mission> read_mission(const std::filesystem::path& file);

/// The same for a text in memory; `file` names it in messages and anchors relative paths.
Result<Mission> parse_mission(std::string_view toml, const std::filesystem::path& file);

}  // namespace aerogram::planner
