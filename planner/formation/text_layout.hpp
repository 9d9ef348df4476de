#pragma once
#include <string_view>
#include <vector>

#include "geo/result.hpp"
#include "planner/formation/stroke_font.hpp"

namespace aerogram::planner {

/// The letters of a text as strokes in font units, in reading order; each next letter stands one glyph width further,
/// lines
/// ('\n') are centred under each other. Characters without strokes (spaces) only take room.
/// @param utf8  the text.
/// Errors: invalid_input naming the first character that the font does not draw, or when nothing is drawn at all.
Result<std::vector<std::vector<Stroke>>> lay_out(std::string_view utf8, const StrokeFont& font);

}  // namespace aerogram::planner
