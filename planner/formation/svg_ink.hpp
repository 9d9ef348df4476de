#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "geo/color.hpp"
#include "planner/drawing/path.hpp"
#include "planner/drawing/svg.hpp"
#include "planner/sampling/region.hpp"

namespace aerogram::planner {

/// What drones can show of one shape, drawing units.
struct InkLayer {
    std::size_t shape = 0;  ///< into Drawing::shapes
    Region area;            ///< by contours that do not cross: a fill with its stroke, or what a line's pen covers
    Chords lines;           ///< of a stroke without fill: what drones stand on instead of the area; else empty
    Rgb color;              ///< of the lamps
    bool dark = false;      ///< shows nothing but hides what is beneath
};

/// A drawing as light on a dark sky, painter's order.
struct Ink {
    std::vector<InkLayer> layers;
    std::string note;  ///< what was changed: paper left out, black made bright
};

/// Paper and black are turned into light. A white rectangle beneath all others that covers the page is paper and left
/// out. Where all else is black and white, white is paper too (dark, but it hides), and black is lit white. In coloured
/// drawings black is lit white, or dim (a sixth) where white is drawn as well.
/// A fill's own stroke widens it and has its colour, unless the fill is dark.
[[nodiscard]] Ink ink_of(const Drawing& drawing);

/// The layers without what later ones hide: areas disjoint, lines cut by areas; dark layers are gone. Layers keep their
/// order, empty ones are gone. Where that would cost too much (more than 20,000 layers, or too many of them over one
/// another) nothing is hidden, and the note says so.
[[nodiscard]] Ink visible(const Ink& ink);

/// The union of all areas, dark layers cut out of what is beneath. Nothing when it would cost too much.
[[nodiscard]] std::optional<Region> inked_area(const Ink& ink);

}  // namespace aerogram::planner
