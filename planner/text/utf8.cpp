#include "planner/text/utf8.hpp"

#include <cstddef>
#include <cstdio>

namespace aerogram::planner {
namespace {

std::string numbered(char32_t code) {
    char number[16];
    std::snprintf(number, sizeof number, "U+%04X", static_cast<unsigned>(code));
    return number;
}

std::string encoded(char32_t code) {
    const auto tail = [&](unsigned shift) { return static_cast<char>(0x80U | ((code >> shift) & 0x3FU)); };
    if (code < 0x80) return {static_cast<char>(code)};
    if (code < 0x800) return {static_cast<char>(0xC0U | (code >> 6U)), tail(0)};
    if (code < 0x10000) return {static_cast<char>(0xE0U | (code >> 12U)), tail(6), tail(0)};
    return {static_cast<char>(0xF0U | (code >> 18U)), tail(12), tail(6), tail(0)};
}

}  // namespace

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
    const auto lead = static_cast<unsigned char>(character.front());
    const bool shown = lead >= 0x20 && lead != 0x7F && (lead < 0x80 || character.size() > 1);
    const std::string number = numbered(code_point(character));
    return shown ? "\"" + std::string(character) + "\" (" + number + ")" : number;
}

std::string name_of_character(char32_t character) {
    return name_of_character(encoded(character));
}

Result<std::u32string> code_points(std::string_view text) {
    std::u32string out;
    for (std::string_view rest = text; !rest.empty();) {
        const std::string_view character = first_character(rest);
        const char32_t code = code_point(character);
        const bool surrogate = code >= 0xD800 && code < 0xE000;
        const bool shortest = code <= 0x10FFFF && encoded(code) == character;
        if (surrogate || !shortest) {
            return Error{ErrorCode::invalid_input,
                         "is not UTF-8 at byte " + std::to_string(text.size() - rest.size() + 1)};
        }
        out.push_back(code);
        rest.remove_prefix(character.size());
    }
    return out;
}

}  // namespace aerogram::planner
