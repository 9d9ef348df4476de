#pragma once
#include <string>
#include <string_view>

#include "geo/result.hpp"

namespace aerogram::planner {

/// The bytes of the UTF-8 character at the start of a text that is not empty; one byte where it is malformed.
[[nodiscard]] std::string_view first_character(std::string_view text);

/// Its code point; a malformed byte's value.
[[nodiscard]] char32_t code_point(std::string_view character);

/// As messages call it: `"é" (U+00E9)`, or `U+0009` when it cannot be shown.
[[nodiscard]] std::string name_of_character(std::string_view character);
[[nodiscard]] std::string name_of_character(char32_t character);

/// The code points of a text. Errors: invalid_input when it is not UTF-8 (message names the byte), surrogates and
/// needlessly long forms included.
Result<std::u32string> code_points(std::string_view text);

}  // namespace aerogram::planner
