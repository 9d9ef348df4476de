#pragma once
#include <string>
#include <string_view>

namespace aerogram::planner {

/// The text of a commented mission to start from: 10 drones write two letters. It parses without a problem.
/// @param name  the show's name, UTF-8 without control characters; empty: "new show".
[[nodiscard]] std::string mission_template(std::string_view name);

}  // namespace aerogram::planner
