#pragma once
#include "geo/result.hpp"
#include "planner/mission/mission.hpp"
#include "planner/sampling/region.hpp"

namespace aerogram::planner {

/// The outlines of a text in a font that has them, in font units, as seen from left to right, lines under each other
/// and aligned, or the one line along a drawn one (baseline.hpp). Outlines of letters that touch overlap. Errors:
/// invalid_input when the font is not installed or not a font, lacks a character (named), the text draws nothing, has
/// several lines along one, or more than 10,000 bytes; io when the file cannot be read.
Result<Region> outline_text(const TextSource& source);

}  // namespace aerogram::planner
