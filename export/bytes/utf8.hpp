#pragma once
#include <string_view>

namespace aerogram::exporter {

/// True for well-formed UTF-8 (no overlong forms, surrogates or code points above U+10FFFF) without control characters.
[[nodiscard]] bool is_plain_utf8(std::string_view text);

}  // namespace aerogram::exporter
