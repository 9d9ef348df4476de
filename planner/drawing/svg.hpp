#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geo/color.hpp"
#include "geo/result.hpp"
#include "planner/sampling/region.hpp"
#include "planner/sampling/stroke.hpp"

namespace aerogram::planner {

/// One shape of a drawing, in the drawing's units, y up, after all transforms.
struct DrawnShape {
    std::string id;             ///< its own, or its nearest group's; may be empty
    std::vector<Stroke> lines;  ///< subpaths as drawn, curves as chords within 1/4000 of the page's longer side
    std::vector<bool> closed;   ///< one a subpath
    Region area;                ///< what a fill paints, by its fill rule; empty for lines
    std::optional<Rgb> fill;    ///< linear; absent: none
    std::optional<Rgb> stroke;  ///< linear; absent: none
    double stroke_width = 1.0;
};

struct Drawing {
    std::vector<DrawnShape> shapes;     ///< painter's order: later ones hide earlier ones
    Vec2 view_low{}, view_high{};       ///< the viewBox, or the page, or the box of all, y up
    std::vector<std::string> warnings;  ///< what was left out: "line 12: text is not drawn; convert it to paths"
};

/// Reads an SVG file: paths, basic shapes, groups, use, symbols, clip paths, transforms, presentation attributes, style
/// attributes and style sheets of simple selectors (css_sheet.hpp). Text, images, filters, masks, markers, scripts and
/// animation are left out with a warning; links out of the file are never followed; entities of a DOCTYPE are not
/// replaced. Gradients count as the mean of their stops; what is fainter than a quarter is not drawn, all else is
/// opaque. Properties: (1) deterministic (2) areas by their fill rule, whichever it is (3) what is clipped away is
/// gone. Errors: io when it cannot be read or is larger than 64 MiB; invalid_input ("line 3: ...") when it is not
/// well-formed, nests deeper than 256, has more than 10^6 elements, 10^6 path segments or 2 * 10^6 elements after
/// `use`, shows itself by `use`, or draws nothing.
Result<Drawing> read_svg(const std::filesystem::path& file);
/// From the bytes of such a file. Errors: invalid_input, as above, without the file's name.
Result<Drawing> parse_svg(std::string_view bytes);

}  // namespace aerogram::planner
