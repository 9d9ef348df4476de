#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "geo/result.hpp"
#include "planner/sampling/stroke.hpp"

namespace aerogram::planner {

/// One character of a single-stroke font, in font units; the pen starts at x = 0 on the baseline y = 0.
struct Glyph {
    double width = 0.0;  ///< from this character's origin to the next one's
    std::vector<Stroke> strokes;
};

/// A font drawn with single lines (Hershey "Roman simplex").
struct StrokeFont {
    static constexpr double kCapHeight = 21.0;  ///< font units
    static constexpr double kLinePitch = 32.0;  ///< font units between baselines

    std::array<std::optional<Glyph>, 128> glyphs;  ///< by ASCII code; absent: the font does not draw it
};

/// The font called `name` among the Hershey fonts installed on the system.
/// Errors: io when it is not installed (message names the package).
Result<StrokeFont> load_stroke_font(const std::string& name = "rowmans");

}  // namespace aerogram::planner
