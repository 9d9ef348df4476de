#include "planner/text/text_layout.hpp"

#include <string>

#include "planner/text/utf8.hpp"

namespace aerogram::planner {
namespace {

const Glyph* glyph_of(std::string_view character, const StrokeFont& font) {
    const auto code = static_cast<unsigned char>(character.front());
    return code < font.glyphs.size() && font.glyphs[code] ? &*font.glyphs[code] : nullptr;
}

Error unknown_character(std::string_view character) {
    return {ErrorCode::invalid_input, "character " + name_of_character(character) +
                                          " is not in the stroke font, which has the printable characters of ASCII"};
}

}  // namespace

Result<std::vector<std::vector<Stroke>>> lay_out(std::string_view utf8, const StrokeFont& font, TextAlign align) {
    const double before = line_start_share(align);
    std::vector<std::vector<Stroke>> letters;
    std::size_t line_start = 0;  // into letters
    Vec2 pen{};
    const auto end_line = [&] {
        for (std::size_t i = line_start; i < letters.size(); ++i) {
            for (Stroke& stroke : letters[i]) {
                for (Vec2& p : stroke) p.x -= before * pen.x;
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
