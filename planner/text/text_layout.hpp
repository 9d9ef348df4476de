#pragma once
#include <cstddef>
#include <string_view>
#include <vector>

#include "geo/result.hpp"
#include "planner/mission/mission.hpp"
#include "planner/text/stroke_font.hpp"

namespace aerogram::planner {

/// The letters of a text as strokes in font units, in reading order; each next letter stands one glyph width further,
/// lines ('\n') stand under each other, aligned. Characters without strokes (spaces) only take room.
/// @param utf8  the text.
/// Errors: invalid_input naming the first character that the font does not draw, or when nothing is drawn at all.
Result<std::vector<std::vector<Stroke>>> lay_out(std::string_view utf8, const StrokeFont& font,
                                                 TextAlign align = TextAlign::center);

/// The strokes of a whole text source, a letter each: laid out in lines, or the one line along a drawn one
/// (baseline.hpp), each letter the middle of its own room on it.
/// Errors: as lay_out; io when the stroke font is not installed; invalid_input for several lines along one.
Result<std::vector<std::vector<Stroke>>> stroke_text(const TextSource& source);

/// What a text of several lines along one line is told.
[[nodiscard]] Error several_lines_along(std::size_t lines);

/// How much of a line's width stands left of the line that all are aligned at.
[[nodiscard]] constexpr double line_start_share(TextAlign align) {
    return align == TextAlign::left ? 0.0 : align == TextAlign::center ? 0.5 : 1.0;
}

}  // namespace aerogram::planner
