#pragma once
#include <optional>
#include <string_view>

#include "planner/drawing/path.hpp"
#include "planner/drawing/svg_style.hpp"
#include "planner/drawing/xml_tree.hpp"

namespace aerogram::planner {

/// The size of the page or of the innermost <svg> or <symbol>, user units: what percentages are of.
struct Viewport {
    double width = 0.0, height = 0.0;
    [[nodiscard]] double diagonal() const;
};

/// Whether the element is a path or a basic shape.
[[nodiscard]] bool is_shape(std::string_view name);

/// The path of such an element in its own coordinates, y down; empty when it has no extent (SVG draws nothing then).
[[nodiscard]] Path shape_path(const XmlTree& tree, std::size_t element, const Viewport& viewport,
                              DrawingWarnings& warnings);

/// Reads a length; absent when it is missing or wrong (with a warning).
[[nodiscard]] std::optional<double> length_at(const XmlTree& tree, std::size_t element, std::string_view name,
                                              double whole, DrawingWarnings& warnings);

struct ViewBox {
    Vec2 low{}, size{};
};
/// Absent when it is missing; wrong ones give a warning.
[[nodiscard]] std::optional<ViewBox> view_box(const XmlTree& tree, std::size_t element, DrawingWarnings& warnings);

/// What maps a view box onto a box of this size at (0, 0), by preserveAspectRatio.
[[nodiscard]] Affine fitted(const ViewBox& box, const Vec2& size, std::string_view preserve_aspect_ratio);

}  // namespace aerogram::planner
