#pragma once
#include <cmath>
#include <cstdlib>
#include <string_view>

#include "planner/drawing/svg.hpp"

/// What the fuzz target of SVG drawings does with any bytes: they are a sound drawing, or refused with a line.
namespace aerogram::planner::fuzz {

inline void insist(bool holds) {
    if (!holds) std::abort();
}

inline void insist_finite(const Vec2& p) {
    insist(std::isfinite(p.x) && std::isfinite(p.y));
}

inline void try_svg(std::string_view bytes) {
    const auto drawing = parse_svg(bytes);
    if (!drawing) {
        insist(drawing.error().code == ErrorCode::invalid_input && drawing.error().message.starts_with("line "));
        return;
    }
    insist(!drawing->shapes.empty());
    insist_finite(drawing->view_low);
    insist_finite(drawing->view_high);
    for (const DrawnShape& shape : drawing->shapes) {
        insist(shape.lines.size() == shape.closed.size() && (shape.fill || shape.stroke));
        insist(shape.fill.has_value() == !shape.area.contours.empty());
        for (const Stroke& line : shape.lines) {
            insist(line.size() >= 2);
            for (const Vec2& p : line) insist_finite(p);
        }
        for (const Contour& contour : shape.area.contours) {
            insist(contour.size() >= 3);
            for (const Vec2& p : contour) insist_finite(p);
        }
    }
    for (const std::string& warning : drawing->warnings) {
        insist(warning.starts_with("line ") || warning.starts_with("and "));
    }
}

}  // namespace aerogram::planner::fuzz
