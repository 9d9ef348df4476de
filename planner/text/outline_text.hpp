#pragma once
#include "geo/result.hpp"
#include "planner/mission/mission.hpp"
#include "planner/sampling/region.hpp"

namespace aerogram::planner {

/// The outlines of a text in a font that has them, in font units, reading order, lines under each other and aligned.
/// Errors: invalid_input when the font is not installed or not a font, lacks a character (named) or draws nothing; io
/// when its file cannot be read.
Result<Region> outline_text(const TextSource& source);

}  // namespace aerogram::planner
