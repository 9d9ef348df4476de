#include <cmath>
#include <svgpp/factory/integer_color.hpp>
#include <svgpp/parser/external_function/parse_color_impl.hpp>
#include <svgpp/parser/external_function/parse_path_data_impl.hpp>
#include <svgpp/parser/external_function/parse_transform_impl.hpp>

#include "geo/units.hpp"
#include "planner/drawing/svg_grammar.hpp"

namespace aerogram::planner {
namespace {

using Absolute = svgpp::tag::coordinate::absolute;
using Relative = svgpp::tag::coordinate::relative;

// SVG++'s interfaces have no virtual destructor; nothing is deleted through them.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wnon-virtual-dtor"

/// SVG++'s events drawn with a pen.
class PenEvents final : public svgpp::detail::path_events_interface<double> {
  public:
    void path_move_to(double x, double y, Absolute) override { pen.move({x, y}); }
    void path_move_to(double x, double y, Relative) override { pen.move(from({x, y})); }
    void path_line_to(double x, double y, Absolute) override { pen.line({x, y}); }
    void path_line_to(double x, double y, Relative) override { pen.line(from({x, y})); }
    void path_line_to_ortho(double v, bool horizontal, Absolute) override {
        pen.line(horizontal ? Vec2(v, pen.here().y) : Vec2(pen.here().x, v));
    }
    void path_line_to_ortho(double v, bool horizontal, Relative) override {
        pen.line(from(horizontal ? Vec2(v, 0.0) : Vec2(0.0, v)));
    }
    void path_cubic_bezier_to(double x1, double y1, double x2, double y2, double x, double y, Absolute) override {
        pen.cubic({x1, y1}, {x2, y2}, {x, y});
    }
    void path_cubic_bezier_to(double x1, double y1, double x2, double y2, double x, double y, Relative) override {
        pen.cubic(from({x1, y1}), from({x2, y2}), from({x, y}));
    }
    void path_cubic_bezier_to(double x2, double y2, double x, double y, Absolute) override {
        pen.smooth_cubic({x2, y2}, {x, y});
    }
    void path_cubic_bezier_to(double x2, double y2, double x, double y, Relative) override {
        pen.smooth_cubic(from({x2, y2}), from({x, y}));
    }
    void path_quadratic_bezier_to(double x1, double y1, double x, double y, Absolute) override {
        pen.quadratic({x1, y1}, {x, y});
    }
    void path_quadratic_bezier_to(double x1, double y1, double x, double y, Relative) override {
        pen.quadratic(from({x1, y1}), from({x, y}));
    }
    void path_quadratic_bezier_to(double x, double y, Absolute) override { pen.smooth_quadratic({x, y}); }
    void path_quadratic_bezier_to(double x, double y, Relative) override { pen.smooth_quadratic(from({x, y})); }
    void path_elliptical_arc_to(double rx, double ry, double turn_deg, bool large, bool sweep, double x, double y,
                                Absolute) override {
        pen.arc({rx, ry}, radians(turn_deg), large, sweep, {x, y});
    }
    void path_elliptical_arc_to(double rx, double ry, double turn_deg, bool large, bool sweep, double x, double y,
                                Relative) override {
        pen.arc({rx, ry}, radians(turn_deg), large, sweep, from({x, y}));
    }
    void path_close_subpath() override { pen.close(); }
    void path_exit() override {}

    PathPen pen;

  private:
    Vec2 from(const Vec2& offset) const { return pen.here() + offset; }
};

/// SVG++'s events multiplied: the last transform is applied first.
class ProductEvents final : public svgpp::detail::transform_events_interface<double> {
  public:
    void transform_matrix(const boost::array<double, 6>& m) override {
        then({{m[0], m[1]}, {m[2], m[3]}, {m[4], m[5]}});
    }
    void transform_translate(double x, double y) override { then({{1.0, 0.0}, {0.0, 1.0}, {x, y}}); }
    void transform_translate(double x) override { transform_translate(x, 0.0); }
    void transform_scale(double x, double y) override { then({{x, 0.0}, {0.0, y}, {}}); }
    void transform_scale(double s) override { transform_scale(s, s); }
    void transform_rotate(double angle_deg) override {
        const double c = std::cos(radians(angle_deg)), s = std::sin(radians(angle_deg));
        then({{c, s}, {-s, c}, {}});
    }
    void transform_rotate(double angle_deg, double x, double y) override {
        transform_translate(x, y);
        transform_rotate(angle_deg);
        transform_translate(-x, -y);
    }
    void transform_skew_x(double angle_deg) override { then({{1.0, 0.0}, {std::tan(radians(angle_deg)), 1.0}, {}}); }
    void transform_skew_y(double angle_deg) override { then({{1.0, std::tan(radians(angle_deg))}, {0.0, 1.0}, {}}); }

    Affine product;

  private:
    void then(const Affine& next) { product = product.after(next); }
};

#pragma GCC diagnostic pop

}  // namespace

PathData parse_path_data(std::string_view text) {
    PenEvents events;
    const char* it = text.data();
    const char* const end = it + text.size();
    const bool understood = svgpp::detail::parse_path_data<const char*, double>(it, end, events);
    return {events.pen.take(), understood && it == end};
}

std::optional<Affine> parse_transforms(std::string_view text) {
    ProductEvents events;
    const char* it = text.data();
    const char* const end = it + text.size();
    if (!svgpp::detail::parse_transform<const char*, double>(it, end, events) || it != end) return std::nullopt;
    return events.product;
}

std::optional<unsigned> parse_srgb(std::string_view text) {
    unsigned value = 0;
    const char* it = text.data();
    const char* const end = it + text.size();
    const bool understood =
        svgpp::detail::parse_color<svgpp::factory::color::integer<unsigned>>(it, end, svgpp::tag::source::css(), value);
    if (!understood || it != end) return std::nullopt;
    return value;
}

}  // namespace aerogram::planner
