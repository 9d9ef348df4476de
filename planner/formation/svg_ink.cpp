#include "planner/formation/svg_ink.hpp"

#include <algorithm>
#include <cmath>

#include "planner/drawing/region_clip.hpp"
#include "planner/picture/picture.hpp"

namespace aerogram::planner {
namespace {

constexpr double kPaperShare = 0.98;      ///< of the page
constexpr double kPaperLuminance = 0.9;   ///< at least
constexpr double kBlackLuminance = 0.01;  ///< at most
constexpr double kColoured = 0.05;        ///< difference of channels
constexpr double kLeastArea = 1e-9;       ///< of a fill, of the squared page: less is a line drawn as an area
constexpr double kDim = 1.0 / 6.0;
constexpr std::size_t kLayersAtMost = 20'000;
constexpr std::size_t kPointsAtMost = 20'000'000;  ///< of areas that are cut out of others

bool is_white(const Rgb& c) {
    return luminance(c) >= kPaperLuminance;
}
bool is_black(const Rgb& c) {
    return luminance(c) <= kBlackLuminance && std::max({c.r, c.g, c.b}) < 0.05;
}
bool is_coloured(const Rgb& c) {
    return !is_black(c) && std::max({c.r, c.g, c.b}) - std::min({c.r, c.g, c.b}) > kColoured;
}

double area_of(const Region& region) {
    double sum = 0.0;
    for (const Contour& contour : region.contours) sum += 0.5 * doubled_area(contour);
    return sum;
}

void say(std::string& note, const std::string& what) {
    note += (note.empty() ? "" : "; ") + what;
}

/// The first layer, if it is a sheet of white beneath all others.
bool begins_with_paper(const Drawing& drawing, const std::vector<InkLayer>& layers) {
    if (layers.size() < 2 || !layers.front().lines.lines.empty() || !is_white(layers.front().color)) return false;
    const Vec2 page = drawing.view_high - drawing.view_low;
    const Bounds box = bounds_of(layers.front().area);
    const Vec2 seen = glm::min(box.high, drawing.view_high) - glm::max(box.low, drawing.view_low);
    return seen.x >= kPaperShare * page.x && seen.y >= kPaperShare * page.y &&
           area_of(layers.front().area) >= kPaperShare * box.size().x * box.size().y;
}

void light_up(Ink& ink) {
    bool black = false, white = false, coloured = false;
    for (const InkLayer& layer : ink.layers) {
        black = black || is_black(layer.color);
        white = white || is_white(layer.color);
        coloured = coloured || is_coloured(layer.color);
    }
    if (!black) return;
    const bool dims = coloured && white;
    for (InkLayer& layer : ink.layers) {
        if (is_black(layer.color)) {
            layer.color = dims ? Rgb{kDim, kDim, kDim} : Rgb{1.0, 1.0, 1.0};
        } else if (!coloured && is_white(layer.color)) {
            layer.dark = true;
        }
    }
    say(ink.note, dims ? "black is lit dim" : "black is lit white");
    if (white && !coloured) say(ink.note, "white is taken for paper and stays dark");
}

std::size_t points_of(const Region& region) {
    std::size_t count = 0;
    for (const Contour& contour : region.contours) count += contour.size();
    return count;
}

/// The areas of the layers above `below` that reach into its box, one after another. Lines do not hide lines: where
/// they cross, a drone can belong to both.
Region above(const std::vector<InkLayer>& layers, const std::vector<Bounds>& boxes, std::size_t below) {
    Region out;
    for (std::size_t j = below + 1; j < layers.size(); ++j) {
        const bool apart = boxes[j].low.x >= boxes[below].high.x || boxes[j].high.x <= boxes[below].low.x ||
                           boxes[j].low.y >= boxes[below].high.y || boxes[j].high.y <= boxes[below].low.y;
        if (apart || (!layers[j].lines.lines.empty() && !layers[below].lines.lines.empty())) continue;
        const auto& contours = layers[j].area.contours;
        out.contours.insert(out.contours.end(), contours.begin(), contours.end());
    }
    return out;
}

/// False when it would cost too much.
bool hide(InkLayer& layer, const Region& cover) {
    if (cover.contours.empty()) return true;
    if (!layer.lines.lines.empty()) {
        auto lines = clipped(layer.lines, cover, Side::outside);
        if (!lines) return false;
        layer.lines = std::move(*lines);
        if (layer.lines.lines.empty()) layer.area.contours.clear();
    }
    auto area = subtracted(layer.area, cover);
    if (!area) return false;
    layer.area = std::move(*area);
    return true;
}

bool hide_all(std::vector<InkLayer>& layers) {
    if (layers.size() > kLayersAtMost) return false;
    std::vector<Bounds> boxes;
    for (const InkLayer& layer : layers) boxes.push_back(bounds_of(layer.area));
    std::size_t points = 0;
    for (std::size_t i = 0; i < layers.size(); ++i) {  // the layers above are still whole
        const Region cover = above(layers, boxes, i);
        points += points_of(cover) + points_of(layers[i].area);
        if (points > kPointsAtMost || !hide(layers[i], cover)) return false;
    }
    return true;
}

}  // namespace

Ink ink_of(const Drawing& drawing) {
    Ink ink;
    const Vec2 view = drawing.view_high - drawing.view_low;
    const double page = std::max(view.x, view.y);
    bool without_area = false, too_involved = false;
    for (std::size_t s = 0; s < drawing.shapes.size(); ++s) {
        const DrawnShape& shape = drawing.shapes[s];
        InkLayer layer;
        layer.shape = s;
        const Chords lines{shape.lines, shape.closed};
        if (shape.fill) {
            layer.color = *shape.fill;
            auto area = simplified(shape.area, FillRule::nonzero);
            const bool needle = std::abs(area_of(shape.area)) <= kLeastArea * page * page;
            if (!area && !needle) {
                if (!too_involved) say(ink.note, "fills too involved to be drawn are left out: simplify the drawing");
                too_involved = true;
                continue;
            }
            if (area) layer.area = std::move(*area);
            const bool wide = shape.stroke && !is_black(*shape.fill) == !is_black(*shape.stroke);
            if (wide) {
                const Region parts[] = {layer.area, stroked(lines, shape.stroke_width)};
                if (auto both = united(parts)) layer.area = std::move(*both);
            }
        } else {
            layer.color = *shape.stroke;
            layer.lines = lines;
            layer.area = stroked(lines, shape.stroke_width);
            if (auto area = simplified(layer.area, FillRule::nonzero)) layer.area = std::move(*area);
        }
        if (layer.lines.lines.empty() && area_of(layer.area) <= kLeastArea * page * page) {
            if (!without_area) say(ink.note, "fills without an area are left out");
            without_area = true;
            continue;
        }
        if (layer.area.contours.empty()) continue;
        ink.layers.push_back(std::move(layer));
    }
    if (begins_with_paper(drawing, ink.layers)) {
        ink.layers.erase(ink.layers.begin());
        say(ink.note, "the white page is left out");
    }
    light_up(ink);
    return ink;
}

Ink visible(const Ink& ink) {
    Ink out = ink;
    if (!hide_all(out.layers)) {
        out.layers = ink.layers;
        say(out.note, "too many shapes lie over one another: covered ones are shown too");
    }
    std::erase_if(out.layers, [](const InkLayer& layer) { return layer.dark || layer.area.contours.empty(); });
    return out;
}

std::optional<Region> inked_area(const Ink& ink) {
    std::optional<Region> whole = Region{};
    for (std::size_t i = 0; i < ink.layers.size();) {
        const bool dark = ink.layers[i].dark;
        std::vector<Region> parts;
        for (; i < ink.layers.size() && ink.layers[i].dark == dark; ++i) parts.push_back(ink.layers[i].area);
        if (!dark && !whole->contours.empty()) parts.push_back(std::move(*whole));
        auto together = united(parts);
        if (!together) return std::nullopt;
        whole = dark && !whole->contours.empty() ? subtracted(*whole, *together)
                : dark                           ? std::move(whole)
                                                 : std::move(together);
        if (!whole) return std::nullopt;
    }
    return whole;
}

}  // namespace aerogram::planner
