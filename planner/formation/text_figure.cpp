#include <algorithm>
#include <limits>
#include <memory>

#include "planner/drawing/region_clip.hpp"
#include "planner/formation/area_figure.hpp"
#include "planner/formation/figure.hpp"
#include "planner/sampling/stroke_graph.hpp"
#include "planner/sampling/stroke_sampling.hpp"
#include "planner/text/outline_text.hpp"
#include "planner/text/text_layout.hpp"

namespace aerogram::planner {
namespace {

/// The graph of all letters, the middle of the box of all strokes at (0, 0), and the size of that box.
struct Drawing {
    StrokeGraph graph;
    Vec2 size{};
};

Drawing draw(const std::vector<std::vector<Stroke>>& letters) {
    Drawing out;
    Vec2 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
    for (const auto& letter : letters) {
        for (const Stroke& stroke : letter) {
            for (const Vec2& p : stroke) {
                low = glm::min(low, p);
                high = glm::max(high, p);
            }
        }
        append(out.graph, stroke_graph(letter, StrokeFont::kCapHeight));
    }
    const Vec2 middle = 0.5 * (low + high);
    for (Station& station : out.graph.stations) station.at -= middle;
    for (StrokeEdge& edge : out.graph.edges) {
        for (Vec2& p : edge.path) p -= middle;
    }
    out.size = high - low;
    return out;
}

/// The text as it stands in the mission, line breaks written as \n.
std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) out += c == '\n' ? std::string("\\n") : std::string(1, c);
    return out + "\"";
}

AreaStyle area_style(TextStyle style) {
    return style == TextStyle::outline ? AreaStyle::outline
           : style == TextStyle::solid ? AreaStyle::solid
                                       : AreaStyle::fill;
}

/// Letters that touch (joined scripts, syllables, sharp bends) become one area, so that no outline runs inside another.
Result<Figure> in_outlines(const PartRef& ref, const TextSource& source, const std::string& key, const Run& run) {
    auto region = outline_text(source);
    if (!region) return Error{region.error().code, ref.error(key + region.error().message).message};
    auto simple = simplified(*region, FillRule::nonzero);
    if (simple && simple->contours.empty()) return ref.error(key + "the letters enclose no area");
    return area_figure(ref, simple ? std::move(*simple) : std::move(*region), area_style(source.style),
                       source.outline_share, run);
}

}  // namespace

Result<Figure> text_figure(const PartRef& ref, const TextSource& source, const Run& run) {
    const std::string key = ".text = " + quoted(source.text) + ": ";
    if (source.style != TextStyle::stroke) return in_outlines(ref, source, key, run);
    const auto letters = stroke_text(source);
    if (!letters) return Error{letters.error().code, ref.error(key + letters.error().message).message};

    const std::size_t drones = ref.part.drones;
    const auto drawing = std::make_shared<const Drawing>(draw(*letters));
    if (!sample_strokes(drawing->graph, Vec2(1.0), drones)) {
        return ref.error(key + "has only dots: " + std::to_string(drawing->graph.stations.size()) + " places for " +
                         std::to_string(drones) + " drones");
    }
    Figure figure;
    figure.extent = {drawing->size.x, 0.0, drawing->size.y};
    figure.points = [drawing, drones](const Vec3& scale) {
        Points points;
        points.reserve(drones);
        const auto flat = sample_strokes(drawing->graph, {scale.x, scale.z}, drones);
        for (const Vec2& p : flat.value()) points.emplace_back(p.x, 0.0, p.y);
        return points;
    };
    return figure;
}

}  // namespace aerogram::planner
