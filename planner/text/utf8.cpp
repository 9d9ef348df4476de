#include "planner/text/utf8.hpp"

#include <cstddef>
#include <cstdio>

namespace aerogram::planner {

std::string_view first_character(std::string_view text) {
    const auto lead = static_cast<unsigned char>(text.front());
    const std::size_t length = lead < 0xC0 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
    for (std::size_t i = 1; i < length; ++i) {
        if (i >= text.size() || (static_cast<unsigned char>(text[i]) & 0xC0U) != 0x80U) return text.substr(0, 1);
    }
    return text.substr(0, length);
}

char32_t code_point(std::string_view character) {
    const auto lead = static_cast<unsigned char>(character.front());
    unsigned value = character.size() == 1 ? lead : lead & (0x7FU >> character.size());
    for (const char c : character.substr(1)) value = value << 6U | (static_cast<unsigned char>(c) & 0x3FU);
    return value;
}

std::string name_of_character(std::string_view character) {
    char number[16];
    std::snprintf(number, sizeof number, "U+%04X", static_cast<unsigned>(code_point(character)));
    const auto lead = static_cast<unsigned char>(character.front());
    const bool shown = lead >= 0x20 && lead != 0x7F && (lead < 0x80 || character.size() > 1);
    return shown ? "\"" + std::string(character) + "\" (" + number + ")" : number;
}

}  // namespace aerogram::planner
