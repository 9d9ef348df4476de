#pragma once
#include <limits>
#include <string>
#include <string_view>

#include "geo/result.hpp"
#include "planner/sampling/region.hpp"
#include "planner/text/outline_font.hpp"

namespace aerogram::exporter {

/// A line of text ready to be drawn: outlines in pixels, y down, from the start of the baseline at (0, 0).
struct Label {
    planner::Region outlines;
    double width = 0.0;
};

/// Draws the words of pictures: outlines of DejaVu Sans by FreeType and HarfBuzz, filled like any other region. Neither
/// hinting nor the system's text settings take part, so that a font file alone decides what a label looks like.
/// Characters that DejaVu Sans lacks come from the first installed family that has them; those that none has are "?".
class Lettering {
  public:
    /// Errors: invalid_input when DejaVu Sans is not installed (message names the package); io when it cannot be read.
    static Result<Lettering> load();

    /// @param utf8  one line; control characters are spaces. @param size_px  of an em.
    /// @param longest_px  a wider text is cut at a character and ends in "…".
    [[nodiscard]] Label label(std::string_view utf8, double size_px,
                              double longest_px = std::numeric_limits<double>::infinity()) const;

  private:
    explicit Lettering(planner::FontData font) : font_(std::move(font)) {}

    planner::FontData font_;
};

}  // namespace aerogram::exporter
