#include "planner/drawing/svg_shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "planner/drawing/svg_grammar.hpp"

namespace aerogram::planner {
namespace {

constexpr std::array<std::string_view, 7> kShapes{"path", "rect", "circle", "ellipse", "line", "polyline", "polygon"};

/// Lengths of one element.
class Lengths {
  public:
    Lengths(const XmlTree& tree, std::size_t element, const Viewport& viewport, DrawingWarnings& warnings)
        : tree_(tree), element_(element), viewport_(viewport), warnings_(warnings) {}

    double across(std::string_view name) const { return get(name, viewport_.width).value_or(0.0); }
    double up(std::string_view name) const { return get(name, viewport_.height).value_or(0.0); }
    double any(std::string_view name) const { return get(name, viewport_.diagonal()).value_or(0.0); }
    std::optional<double> get(std::string_view name, double whole) const {
        return length_at(tree_, element_, name, whole, warnings_);
    }
    std::optional<double> radius(std::string_view name, double whole) const {
        const auto r = get(name, whole);
        return r && *r >= 0.0 ? r : std::nullopt;
    }

  private:
    const XmlTree& tree_;
    std::size_t element_;
    const Viewport& viewport_;
    DrawingWarnings& warnings_;
};

Path ellipse(const Vec2& centre, double rx, double ry) {
    if (!(rx > 0.0 && ry > 0.0)) return {};
    PathPen pen;
    pen.move(centre + Vec2(rx, 0.0));
    for (const Vec2& to : {Vec2(0.0, ry), Vec2(-rx, 0.0), Vec2(0.0, -ry), Vec2(rx, 0.0)}) {
        pen.arc({rx, ry}, 0.0, false, true, centre + to);
    }
    pen.close();
    return pen.take();
}

Path rectangle(const Lengths& get, const Viewport& viewport) {
    const Vec2 low(get.across("x"), get.up("y")), size(get.across("width"), get.up("height"));
    if (!(size.x > 0.0 && size.y > 0.0)) return {};
    const auto given_x = get.radius("rx", viewport.width), given_y = get.radius("ry", viewport.height);
    const double rx = std::min(given_x ? *given_x : given_y.value_or(0.0), 0.5 * size.x);
    const double ry = std::min(given_y ? *given_y : given_x.value_or(0.0), 0.5 * size.y);
    const Vec2 high = low + size, radii(rx, ry);
    const bool round = rx > 0.0 && ry > 0.0;
    PathPen pen;
    if (!round) {
        pen.move(low);
        pen.line({high.x, low.y});
        pen.line(high);
        pen.line({low.x, high.y});
    } else {
        const auto side = [&](const Vec2& to, const Vec2& corner) {
            if (to != pen.here()) pen.line(to);
            pen.arc(radii, 0.0, false, true, corner);
        };
        pen.move({low.x + rx, low.y});
        side({high.x - rx, low.y}, {high.x, low.y + ry});
        side({high.x, high.y - ry}, {high.x - rx, high.y});
        side({low.x + rx, high.y}, {low.x, high.y - ry});
        side({low.x, low.y + ry}, {low.x + rx, low.y});
    }
    pen.close();
    return pen.take();
}

Path corners(const XmlTree& tree, std::size_t element, bool closed) {
    const std::vector<double> numbers = parse_numbers(tree.attribute(element, "points"));
    PathPen pen;
    for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) {
        const Vec2 p(numbers[i], numbers[i + 1]);
        if (i == 0) {
            pen.move(p);
        } else {
            pen.line(p);
        }
    }
    if (closed) pen.close();
    return pen.take();
}

}  // namespace

double Viewport::diagonal() const {
    return std::sqrt(0.5 * (width * width + height * height));
}

bool is_shape(std::string_view name) {
    return std::find(kShapes.begin(), kShapes.end(), name) != kShapes.end();
}

std::optional<double> length_at(const XmlTree& tree, std::size_t element, std::string_view name, double whole,
                                DrawingWarnings& warnings) {
    const std::string_view text = tree.attribute(element, name);
    if (trimmed(text).empty() || text == "auto") return std::nullopt;
    const auto length = parse_length(text, whole);
    if (!length) {
        warnings.add(tree.elements[element].line, std::string(name) + " = \"" + std::string(text.substr(0, 40)) +
                                                      "\" is no length and counts for nothing");
    }
    return length;
}

Path shape_path(const XmlTree& tree, std::size_t element, const Viewport& viewport, DrawingWarnings& warnings) {
    const std::string_view name = local_name(tree.elements[element].name);
    const Lengths get(tree, element, viewport, warnings);
    if (name == "path") {
        PathData data = parse_path_data(tree.attribute(element, "d"));
        if (!data.complete) {
            warnings.add(tree.elements[element].line, "path data stop making sense; the path is drawn up to there");
        }
        return std::move(data.path);
    }
    if (name == "rect") return rectangle(get, viewport);
    if (name == "circle") return ellipse({get.across("cx"), get.up("cy")}, get.any("r"), get.any("r"));
    if (name == "ellipse") {
        const auto rx = get.radius("rx", viewport.width), ry = get.radius("ry", viewport.height);
        return ellipse({get.across("cx"), get.up("cy")}, rx ? *rx : ry.value_or(0.0), ry ? *ry : rx.value_or(0.0));
    }
    if (name == "line") {
        PathPen pen;
        pen.move({get.across("x1"), get.up("y1")});
        pen.line({get.across("x2"), get.up("y2")});
        return pen.take();
    }
    return corners(tree, element, name == "polygon");
}

std::optional<ViewBox> view_box(const XmlTree& tree, std::size_t element, DrawingWarnings& warnings) {
    const std::string_view text = tree.attribute(element, "viewBox");
    if (text.empty()) return std::nullopt;
    const std::vector<double> n = parse_numbers(text);
    if (n.size() == 4 && n[2] > 0.0 && n[3] > 0.0) return ViewBox{{n[0], n[1]}, {n[2], n[3]}};
    warnings.add(tree.elements[element].line, "viewBox is not understood and counts for nothing");
    return std::nullopt;
}

Affine fitted(const ViewBox& box, const Vec2& size, std::string_view preserve) {
    const Vec2 stretch = size / box.size;
    const std::string_view how = trimmed(preserve);
    if (how.starts_with("none")) return {{stretch.x, 0.0}, {0.0, stretch.y}, -box.low * stretch};
    const bool slice = how.find("slice") != std::string_view::npos;
    const double scale = slice ? std::max(stretch.x, stretch.y) : std::min(stretch.x, stretch.y);
    const auto share = [&](std::string_view low, std::string_view high) {
        return how.find(low) != std::string_view::npos ? 0.0 : how.find(high) != std::string_view::npos ? 1.0 : 0.5;
    };
    const Vec2 spare = size - box.size * scale;
    const Vec2 at(spare.x * share("xMin", "xMax"), spare.y * share("YMin", "YMax"));
    return {{scale, 0.0}, {0.0, scale}, at - box.low * scale};
}

}  // namespace aerogram::planner
