#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "geo/result.hpp"

/// A TOML text as a small tree with line numbers: all that the mission checks need to know of TOML.
namespace aerogram::planner {

struct TomlValue;
struct TomlEntry;
using TomlArray = std::vector<TomlValue>;
using TomlTable = std::vector<TomlEntry>;  ///< in file order; keys are unique
struct TomlDate {};                        ///< any TOML date or time; no key of a mission is one

struct TomlValue {
    std::variant<bool, std::int64_t, double, std::string, TomlDate, TomlArray, TomlTable> data;
    int line = 0;  ///< from 1
};
struct TomlEntry {
    std::string key;
    int line = 0;
    TomlValue value;
};

/// The tree of a TOML 1.0 text; the root is a table at line 1.
/// @param file  names the text in messages.
/// Errors: invalid_input "file:line: not TOML: why"; also for texts nested deeper than any mission needs.
Result<TomlValue> parse_toml(std::string_view text, const std::filesystem::path& file);

/// A value as a message shows it: one line, at most about 60 characters.
[[nodiscard]] std::string shown(const TomlValue& value);

/// A number in its shortest exact form, e.g. 0.05, 3, -1.5.
[[nodiscard]] std::string shown(double value);

/// A string in quotes, control characters escaped, long ones cut.
[[nodiscard]] std::string in_quotes(std::string_view text);

}  // namespace aerogram::planner
