#include "planner/formation/text_layout.hpp"

#include <algorithm>
#include <cstdio>
#include <string>

namespace aerogram::planner {
namespace {

/// The bytes of the UTF-8 character at the text's start; one byte where it is malformed.
std::string_view first_character(std::string_view text) {
    const auto lead = static_cast<unsigned char>(text.front());
    const std::size_t length = lead < 0xC0 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
    for (std::size_t i = 1; i < length; ++i) {
        if (i >= text.size() || (static_cast<unsigned char>(text[i]) & 0xC0U) != 0x80U) return text.substr(0, 1);
    }
    return text.substr(0, length);
}

/// "U+00E9" of one character as first_character() cut it.
std::string code_point(std::string_view character) {
    const auto lead = static_cast<unsigned char>(character.front());
    unsigned value = character.size() == 1 ? lead : lead & (0x7FU >> character.size());
    for (const char c : character.substr(1)) value = value << 6U | (static_cast<unsigned char>(c) & 0x3FU);
    char text[16];
    std::snprintf(text, sizeof text, "U+%04X", value);
    return text;
}

const Glyph* glyph_of(std::string_view character, const StrokeFont& font) {
    const auto code = static_cast<unsigned char>(character.front());
    return code < font.glyphs.size() && font.glyphs[code] ? &*font.glyphs[code] : nullptr;
}

Error unknown_character(std::string_view character) {
    const auto lead = static_cast<unsigned char>(character.front());
    const bool shown = lead >= 0x20 && lead != 0x7F && (lead < 0x80 || character.size() > 1);
    const std::string name =
        shown ? "\"" + std::string(character) + "\" (" + code_point(character) + ")" : code_point(character);
    return {ErrorCode::invalid_input,
            "character " + name + " is not in the stroke font, which has the printable characters of ASCII"};
}

}  // namespace

Result<std::vector<std::vector<Stroke>>> lay_out(std::string_view utf8, const StrokeFont& font) {
    std::vector<std::vector<Stroke>> letters;
    std::size_t line_start = 0;  // into letters
    Vec2 pen{};
    const auto end_line = [&] {
        for (std::size_t i = line_start; i < letters.size(); ++i) {
            for (Stroke& stroke : letters[i]) {
                for (Vec2& p : stroke) p.x -= 0.5 * pen.x;
            }
        }
        line_start = letters.size();
        pen = {0.0, pen.y - StrokeFont::kLinePitch};
    };
    while (!utf8.empty()) {
        const std::string_view character = first_character(utf8);
        utf8.remove_prefix(character.size());
        if (character == "\n") {
            end_line();
            continue;
        }
        const Glyph* glyph = glyph_of(character, font);
        if (glyph == nullptr) return unknown_character(character);
        std::vector<Stroke> letter = glyph->strokes;
        for (Stroke& stroke : letter) {
            for (Vec2& p : stroke) p += pen;
        }
        if (!letter.empty()) letters.push_back(std::move(letter));
        pen.x += glyph->width;
    }
    end_line();
    if (letters.empty()) return Error{ErrorCode::invalid_input, "the text draws nothing"};
    return letters;
}

}  // namespace aerogram::planner
