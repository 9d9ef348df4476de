#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "planner/drawing/region_clip.hpp"
#include "planner/drawing/svg.hpp"
#include "planner/formation/area_figure.hpp"
#include "planner/formation/figure.hpp"
#include "planner/formation/part_density.hpp"
#include "planner/formation/svg_colors.hpp"
#include "planner/formation/svg_frames.hpp"
#include "planner/formation/svg_points.hpp"
#include "planner/picture/palette.hpp"

namespace aerogram::planner {
namespace {

void say(std::string& note, const std::string& what) {
    if (!what.empty()) note += (note.empty() ? "" : "; ") + what;
}

std::string nothing_lit(const Ink& ink) {
    return "shows nothing that is lit" + (ink.note.empty() ? "" : " (" + ink.note + ")");
}

/// All that is painted, as one area in the style asked for, coloured by place.
Result<Figure> as_area(const PartRef& ref, const SvgSource& source, const Ink& ink, const std::string& key,
                       const Run& run) {
    auto area = inked_area(ink);
    std::string note;
    if (!area) {
        area = Region{};
        for (const InkLayer& layer : ink.layers) {
            if (layer.dark) continue;
            area->contours.insert(area->contours.end(), layer.area.contours.begin(), layer.area.contours.end());
        }
        note = "too many shapes lie over one another to be one area: each is shown on its own";
    }
    if (area->contours.empty()) return ref.error(key + nothing_lit(ink));
    const Bounds box = bounds_of(*area);
    double filled = 0.0;
    for (const Contour& contour : area->contours) filled += 0.5 * doubled_area(contour);
    const AreaStyle style = source.style == SvgStyle::outline ? AreaStyle::outline
                            : source.style == SvgStyle::solid ? AreaStyle::solid
                                                              : AreaStyle::fill;
    auto figure = area_figure(ref, std::move(*area), style, source.outline_share, run);
    if (!figure) return figure;
    const auto colors = std::make_shared<const InkColors>(ink);
    const double reach = 0.2 * std::sqrt(std::max(filled, 0.0) / static_cast<double>(ref.part.drones));
    const Vec2 middle = 0.5 * (box.low + box.high);
    figure->colors_at = [colors, reach, middle, palette = source.palette](const Points& natural) {
        std::vector<Rgb> out;
        out.reserve(natural.size());
        for (const Vec3& p : natural) out.push_back(colors->at(Vec2(p.x, p.z) + middle, reach));
        return palette ? reduced(out, *palette) : out;
    };
    say(figure->note, note);
    return figure;
}

/// Lines of one colour become one drawing, so that crossings are seen and no two drones stand at one.
void join_lines(std::vector<InkLayer>& layers) {
    std::map<Rgb, std::size_t> first;
    for (std::size_t i = 0; i < layers.size(); ++i) {
        InkLayer& layer = layers[i];
        if (layer.lines.lines.empty()) continue;
        const auto [found, is_new] = first.emplace(layer.color, i);
        if (is_new) continue;
        InkLayer& joined = layers[found->second];
        const auto move = [](auto& from, auto& to) { to.insert(to.end(), from.begin(), from.end()); };
        move(layer.lines.lines, joined.lines.lines);
        move(layer.lines.closed, joined.lines.closed);
        move(layer.area.contours, joined.area.contours);
        layer.area.contours.clear();
    }
    std::erase_if(layers, [](const InkLayer& layer) { return layer.area.contours.empty(); });
}

/// Lines as lines and areas as areas, each shape by drones of its own colour.
Result<Figure> as_drawn(const PartRef& ref, const SvgSource& source, const Ink& ink, const std::string& key,
                        const Run& run) {
    Ink seen = visible(ink);
    join_lines(seen.layers);
    if (seen.layers.empty()) return ref.error(key + nothing_lit(seen));
    if (seen.layers.size() > ref.part.drones) {
        SvgSource whole = source;
        whole.style = SvgStyle::fill;
        auto figure = as_area(ref, whole, ink, key, run);
        if (!figure) return figure;
        say(figure->note, ink.note);
        say(figure->note, "has more shapes than drones: shown as one area");
        return figure;
    }
    const Bounds box = bounds_of(seen.layers);
    const auto layers =
        std::make_shared<const std::vector<InkLayer>>(placed(seen.layers, 0.5 * (box.low + box.high), Vec2(1.0)));
    DensityField density;
    if (!ref.part.density.even()) {
        auto read = density_of(ref, {box.size().x, 0.0, box.size().y});
        if (!read) return read.error();
        density = std::move(*read);
    }
    const auto share = source.outline_share;
    const std::vector<std::size_t> count = share_out(*layers, ref.part.drones, share, density).count;
    Figure figure = flat_figure(box.size(), [layers, count, share, density, run](const Vec2& stretch) {
        const DensityField stretched = density ? DensityField([&](const Vec3& p) {
            return density({p.x / stretch.x, 0.0, p.z / stretch.y});
        })
                                               : DensityField();
        std::vector<Vec2> all;
        for (const auto& points : layer_points(placed(*layers, {}, stretch), count, share, stretched, run)) {
            all.insert(all.end(), points.begin(), points.end());
        }
        return all;
    });
    for (std::size_t i = 0; i < count.size(); ++i)
        figure.colors.insert(figure.colors.end(), count[i], (*layers)[i].color);
    if (source.palette) figure.colors = reduced(figure.colors, *source.palette);
    figure.note = seen.note;
    return figure;
}

}  // namespace

Result<Figure> svg_figure(const PartRef& ref, const SvgSource& source, const Run& run) {
    if (source.frame && source.frame->count > 1) return svg_frame_figure(ref, source, run);
    const std::string key = ".svg = \"" + source.files.front().generic_string() + "\": ";
    const auto drawing = read_svg(source.files.front());
    if (!drawing) return Error{drawing.error().code, ref.error(key + drawing.error().message).message};
    const Ink ink = ink_of(*drawing);
    if (ink.layers.empty()) return ref.error(key + nothing_lit(ink));
    const bool drawn = source.style == SvgStyle::drawn;
    auto figure = drawn ? as_drawn(ref, source, ink, key, run) : as_area(ref, source, ink, key, run);
    if (!figure) return figure;
    std::string note;
    for (const std::string& warning : drawing->warnings) say(note, warning);
    if (!drawn) say(note, ink.note);
    say(note, figure->note);
    figure->note = note;
    return figure;
}

}  // namespace aerogram::planner
