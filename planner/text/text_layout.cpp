#include "planner/text/text_layout.hpp"

#include <algorithm>
#include <string>

#include "planner/text/baseline.hpp"
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

/// A letter in its line, which starts at (0, 0).
struct Letter {
    std::vector<Stroke> strokes;
    double left = 0.0, right = 0.0;  ///< the room that it takes
};
struct Line {
    std::vector<Letter> letters;  ///< those with strokes
    double width = 0.0;
};

Result<std::vector<Line>> lines_of(std::string_view utf8, const StrokeFont& font) {
    std::vector<Line> lines(1);
    while (!utf8.empty()) {
        const std::string_view character = first_character(utf8);
        utf8.remove_prefix(character.size());
        if (character == "\n") {
            lines.emplace_back();
            continue;
        }
        const Glyph* glyph = glyph_of(character, font);
        if (glyph == nullptr) return unknown_character(character);
        Line& line = lines.back();
        Letter letter{glyph->strokes, line.width, line.width + glyph->width};
        for (Stroke& stroke : letter.strokes) {
            for (Vec2& p : stroke) p.x += line.width;
        }
        line.width += glyph->width;
        if (!letter.strokes.empty()) line.letters.push_back(std::move(letter));
    }
    const bool blank = std::all_of(lines.begin(), lines.end(), [](const Line& line) { return line.letters.empty(); });
    if (blank) return Error{ErrorCode::invalid_input, "the text draws nothing"};
    return lines;
}

}  // namespace

Result<std::vector<std::vector<Stroke>>> lay_out(std::string_view utf8, const StrokeFont& font, TextAlign align) {
    auto lines = lines_of(utf8, font);
    if (!lines) return lines.error();
    std::vector<std::vector<Stroke>> letters;
    double baseline = 0.0;
    for (Line& line : *lines) {
        const Vec2 start(-line_start_share(align) * line.width, baseline);
        for (Letter& letter : line.letters) {
            for (Stroke& stroke : letter.strokes) {
                for (Vec2& p : stroke) p += start;
            }
            letters.push_back(std::move(letter.strokes));
        }
        baseline -= StrokeFont::kLinePitch;
    }
    return letters;
}

Result<std::vector<std::vector<Stroke>>> stroke_text(const TextSource& source) {
    const Result<StrokeFont> font = load_stroke_font();
    if (!font) return font.error();
    if (!source.along) return lay_out(source.text, *font, source.align);
    auto lines = lines_of(source.text, *font);
    if (!lines) return lines.error();
    if (lines->size() > 1) return several_lines_along(lines->size());
    Line& line = lines->front();
    const auto along = Baseline::of(*source.along, line.width);
    if (!along) return along.error();
    std::vector<std::vector<Stroke>> letters;
    for (Letter& letter : line.letters) {
        const double middle = 0.5 * (letter.left + letter.right);
        const LetterFrame frame = along->at(middle);
        for (Stroke& stroke : letter.strokes) {
            for (Vec2& p : stroke) p = frame.place(p, middle);
        }
        letters.push_back(std::move(letter.strokes));
    }
    return letters;
}

Error several_lines_along(std::size_t lines) {
    return {ErrorCode::invalid_input, "has " + std::to_string(lines) + " lines; along a line it must have one"};
}

}  // namespace aerogram::planner
