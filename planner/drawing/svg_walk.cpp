#include "planner/drawing/svg_walk.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "planner/drawing/svg_grammar.hpp"
#include "planner/drawing/svg_paints.hpp"
#include "planner/drawing/svg_shapes.hpp"

namespace aerogram::planner {
namespace {

constexpr double kLeastOpacity = 0.25;  ///< what is fainter is not drawn
constexpr double kLargest = 1e12;       ///< coordinates beyond are refused

/// Left out, and what to do about it.
constexpr std::array<std::pair<std::string_view, std::string_view>, 9> kLeftOut{{
    {"text", "text is not drawn; convert it to paths, or use a text source"},
    {"image", "images are not drawn; use an image source"},
    {"foreignObject", "<foreignObject> is not drawn"},
    {"script", "scripts are not run"},
    {"animate", "animation inside the file is not played; use numbered files"},
    {"animateTransform", "animation inside the file is not played; use numbered files"},
    {"animateMotion", "animation inside the file is not played; use numbered files"},
    {"set", "animation inside the file is not played; use numbered files"},
    {"video", "<video> is not drawn"},
}};
/// Hold what others refer to, or words.
constexpr std::array<std::string_view, 17> kSilent{
    "defs",  "symbol", "clipPath", "mask",  "marker", "pattern", "linearGradient", "radialGradient", "filter",
    "title", "desc",   "metadata", "style", "view",   "cursor",  "font",           "font-face"};

struct Place {
    Affine to_page;
    ElementStyle style;
    Viewport viewport;
    std::string_view id;
    std::shared_ptr<const WalkedClip> clip;
    std::size_t depth = 0;
};

class Walk {
  public:
    Walk(const XmlTree& tree, const WalkLimits& limits, DrawingWarnings& warnings)
        : tree_(tree), limits_(limits), warnings_(warnings), paints_(tree, warnings) {}

    Result<WalkedDrawing> run() {
        const XmlElement& root = tree_.elements.front();
        if (local_name(root.name) != "svg") {
            return Error{ErrorCode::invalid_input, "line " + std::to_string(root.line) + ": the file's element is <" +
                                                       std::string(root.name.substr(0, 40)) + ">, not <svg>"};
        }
        look_over();
        visit(0, page());
        if (!problem_.empty()) return Error{ErrorCode::invalid_input, problem_};
        return std::move(out_);
    }

  private:
    void fail(std::size_t element, const std::string& what) {
        if (problem_.empty()) problem_ = "line " + std::to_string(tree_.elements[element].line) + ": " + what;
    }
    std::size_t line(std::size_t element) const { return tree_.elements[element].line; }

    /// Style sheets, ids, and whatever is left out wherever it stands.
    void look_over() {
        for (std::size_t e = 0; e < tree_.elements.size(); ++e) {
            const std::string_view name = local_name(tree_.elements[e].name);
            if (name == "style") sheet_.add(tree_.elements[e].text);
            if (sheet_.left_out() > 0 && name == "style") {
                warnings_.add(line(e),
                              "parts of the style sheet are not understood: only names, .class, #id, their "
                              "compounds and > are");
            }
            if (name == "script" || name == "set" || name.starts_with("animate")) leave_out(e, name);
            if (const std::string_view id = tree_.attribute(e, "id"); !id.empty()) by_id_.emplace(id, e);
            for (const XmlAttribute& a : tree_.attributes_of(e)) {
                const bool ours = a.name.find(':') == std::string_view::npos && a.name != "xmlns";
                if (ours && a.value.starts_with('&') && a.value.ends_with(';')) {
                    warnings_.add(line(e), "entities of the DOCTYPE are not replaced; save the file without them");
                }
            }
        }
    }

    void leave_out(std::size_t element, std::string_view name) {
        for (const auto& [what, message] : kLeftOut) {
            if (what == name) warnings_.add(line(element), std::string(message));
        }
    }

    Place page() {
        const auto box = view_box(tree_, 0, warnings_);
        const auto size_of = [&](std::string_view name, double whole) -> std::optional<double> {
            if (tree_.attribute(0, name).find('%') != std::string_view::npos) return std::nullopt;
            const auto length = length_at(tree_, 0, name, whole, warnings_);
            return length && *length > 0.0 ? length : std::nullopt;
        };
        const auto width = size_of("width", 0.0), height = size_of("height", 0.0);
        Place place;
        if (box) {
            place.viewport = {box->size.x, box->size.y};
            const bool stretch = tree_.attribute(0, "preserveAspectRatio").starts_with("none") && width && height;
            const Vec2 page = stretch ? Vec2(*width, *height) : box->size;
            if (stretch) place.to_page = fitted({{}, box->size}, page, "none");
            out_.low = place.to_page(box->low);
            out_.high = place.to_page(box->low + box->size);
        } else {
            place.viewport = {width.value_or(100.0), height.value_or(100.0)};
            if (width && height) out_.high = {*width, *height};
        }
        return place;
    }

    void visit(std::size_t element, Place place) {
        if (!problem_.empty()) return;
        if (++visits_ > limits_.visits) {
            return fail(element, "more than " + std::to_string(limits_.visits) + " elements after <use>");
        }
        if (++place.depth > limits_.depth) {
            return fail(element, "elements nest deeper than " + std::to_string(limits_.depth) + " with <use>");
        }
        const std::string_view name = local_name(tree_.elements[element].name);
        if (name.find(':') != std::string_view::npos ||
            std::find(kSilent.begin(), kSilent.end(), name) != kSilent.end()) {
            return;
        }
        if (name == "foreignObject" && !tree_.attribute(element, "requiredExtensions").empty()) return;
        if (!enter(element, place)) return;
        if (is_shape(name)) return shape(element, place);
        if (name == "use") return use(element, place);
        if (name == "svg" && element != 0) return viewport(element, place, std::nullopt, std::nullopt);
        if (name == "g" || name == "a" || name == "svg" || name == "switch") return children(element, place);
        const bool known =
            std::any_of(kLeftOut.begin(), kLeftOut.end(), [&](const auto& k) { return k.first == name; });
        if (!known) warnings_.add(line(element), "<" + std::string(name.substr(0, 40)) + "> is not drawn");
        if (name == "text" || name == "image" || name == "foreignObject" || name == "video") leave_out(element, name);
    }

    void children(std::size_t element, const Place& place) {
        for (std::size_t c = tree_.elements[element].first_child; c != kNothing; c = tree_.elements[c].next) {
            visit(c, place);
        }
    }

    /// The element's own style, transform, id and clip. False where nothing in it is drawn.
    bool enter(std::size_t element, Place& place) {
        place.style = style_of(tree_, element, place.style, sheet_, place.viewport.diagonal(), warnings_, tries_);
        if (tries_ > limits_.rule_tries) fail(element, "too many style rules for so many elements");
        if (!place.style.display || place.style.shown < kLeastOpacity || !problem_.empty()) return false;
        if (place.style.filtered) warnings_.add(line(element), "filters are not applied");
        if (place.style.masked) warnings_.add(line(element), "masks are not applied: all of it is drawn");
        if (place.style.marked) warnings_.add(line(element), "markers are not drawn; convert strokes to paths");
        if (const std::string_view text = tree_.attribute(element, "transform"); !text.empty()) {
            if (const auto own = parse_transforms(text)) {
                place.to_page = place.to_page.after(*own);
            } else {
                warnings_.add(line(element), "transform is not understood and counts for nothing");
            }
        }
        if (const std::string_view id = tree_.attribute(element, "id"); !id.empty()) place.id = id;
        if (!place.style.clip.empty()) add_clip(element, place);
        return true;
    }

    void add_clip(std::size_t element, Place& place) {
        const auto found = by_id_.find(place.style.clip);
        if (found == by_id_.end() || local_name(tree_.elements[found->second].name) != "clipPath") {
            return warnings_.add(line(element), "clip-path leads nowhere and counts for nothing");
        }
        const std::size_t source = found->second;
        if (tree_.attribute(source, "clipPathUnits") == "objectBoundingBox") {
            return warnings_.add(line(source), "a clipPath in units of what it clips is not applied");
        }
        auto clip = std::make_shared<WalkedClip>();
        clip->outer = place.clip;
        const auto own = parse_transforms(tree_.attribute(source, "transform"));
        for (std::size_t c = tree_.elements[source].first_child; c != kNothing; c = tree_.elements[c].next) {
            if (++visits_ > limits_.visits) return fail(element, "too many clipped elements");
            if (!is_shape(local_name(tree_.elements[c].name))) {
                warnings_.add(line(c), "a clipPath of anything but paths and basic shapes is not applied");
                return;
            }
            const ElementStyle style = style_of(tree_, c, {}, sheet_, 0.0, warnings_, tries_);
            Affine to_page = place.to_page;
            if (own) to_page = to_page.after(*own);
            if (const auto turn = parse_transforms(tree_.attribute(c, "transform"))) to_page = to_page.after(*turn);
            clip->paths.push_back(transformed(shape_path(tree_, c, place.viewport, warnings_), to_page));
            clip->evenodd.push_back(style.clip_evenodd);
            count(c, clip->paths.back());
        }
        place.clip = std::move(clip);
    }

    /// False, with a problem, when there are too many segments by now, or places beyond all bounds.
    bool count(std::size_t element, const Path& path) {
        segments_ += path.size();
        if (segments_ > limits_.segments) {
            fail(element, "more than " + std::to_string(limits_.segments) + " path segments; simplify the drawing");
        }
        for (const PathStep& s : path) {
            for (const Vec2& p : {s.first, s.second, s.to}) {
                if (!(std::abs(p.x) <= kLargest && std::abs(p.y) <= kLargest)) fail(element, "coordinates beyond 1e12");
            }
        }
        return problem_.empty();
    }

    void shape(std::size_t element, const Place& place) {
        const ElementStyle& style = place.style;
        if (!style.visible) return;
        WalkedShape shape;
        shape.fill = paint(element, style.fill, style, style.fill_opacity);
        shape.stroke = paint(element, style.stroke, style, style.stroke_opacity);
        shape.stroke_width = style.stroke_width * std::sqrt(std::abs(place.to_page.determinant()));
        if (!(shape.stroke_width > 0.0)) shape.stroke.reset();
        if (!shape.fill && !shape.stroke) return;
        if (shape.stroke && style.dashed) warnings_.add(line(element), "dashes are drawn as whole lines");
        shape.path = transformed(shape_path(tree_, element, place.viewport, warnings_), place.to_page);
        if (shape.path.empty() || !count(element, shape.path)) return;
        shape.id = place.id;
        shape.line = line(element);
        shape.evenodd = style.evenodd;
        shape.clip = place.clip;
        out_.shapes.push_back(std::move(shape));
    }

    std::optional<Rgb> paint(std::size_t element, const SvgPaint& paint, const ElementStyle& style, double opacity) {
        if (style.shown * opacity * paint.alpha < kLeastOpacity) return std::nullopt;
        if (paint.kind == SvgPaint::Kind::none) return std::nullopt;
        if (paint.kind == SvgPaint::Kind::color) return paint.light;
        if (paint.kind == SvgPaint::Kind::current) return style.color;
        const auto target = by_id_.find(paint.link);
        const auto light = paints_.mean(target == by_id_.end() ? kNothing : target->second, by_id_, sheet_, tries_);
        if (light.known && style.shown * opacity * light.alpha < kLeastOpacity) return std::nullopt;
        if (light.known) return light.light;
        if (!paint.fallback) {
            warnings_.add(line(element), "a paint that is no gradient of this file is drawn white; use a plain colour");
        }
        return paint.fallback ? paint.light : Rgb{1.0, 1.0, 1.0};
    }

    void use(std::size_t element, Place place) {
        std::string_view link = tree_.attribute(element, "href");
        if (link.empty()) link = tree_.attribute(element, "xlink:href");
        if (!link.starts_with('#')) {
            return warnings_.add(line(element),
                                 "a link out of the file is not followed; put what it shows into the file");
        }
        const auto found = by_id_.find(link.substr(1));
        if (found == by_id_.end()) return warnings_.add(line(element), "<use> shows an element that is not there");
        const std::size_t target = found->second;
        if (std::find(used_.begin(), used_.end(), target) != used_.end()) {
            return fail(element, "<use> shows \"" + std::string(link.substr(1, 40)) + "\", which shows itself");
        }
        for (std::size_t up = element; up != kNothing; up = tree_.elements[up].parent) {
            if (up == target)
                return fail(element, "<use> shows \"" + std::string(link.substr(1, 40)) + "\", which holds it");
        }
        const auto at = [&](std::string_view name, double whole) {
            return length_at(tree_, element, name, whole, warnings_);
        };
        const Vec2 move(at("x", place.viewport.width).value_or(0.0), at("y", place.viewport.height).value_or(0.0));
        place.to_page = place.to_page.after({{1.0, 0.0}, {0.0, 1.0}, move});
        used_.push_back(target);
        const std::string_view name = local_name(tree_.elements[target].name);
        if (name == "symbol" || name == "svg") {
            ++place.depth;
            if (place.depth > limits_.depth) fail(element, "elements nest too deep with <use>");
            if (enter(target, place)) {
                viewport(target, place, at("width", place.viewport.width), at("height", place.viewport.height));
            }
        } else {
            visit(target, place);
        }
        used_.pop_back();
    }

    /// A nested <svg> or a <symbol>: its box, in which its view box is fitted.
    void viewport(std::size_t element, Place place, std::optional<double> width, std::optional<double> height) {
        const auto at = [&](std::string_view name, double whole) {
            return length_at(tree_, element, name, whole, warnings_);
        };
        const Vec2 low(at("x", place.viewport.width).value_or(0.0), at("y", place.viewport.height).value_or(0.0));
        const double whole_x = place.viewport.width, whole_y = place.viewport.height;
        const Vec2 size(width ? *width : at("width", whole_x).value_or(whole_x),
                        height ? *height : at("height", whole_y).value_or(whole_y));
        if (!(size.x > 0.0 && size.y > 0.0)) return;
        place.to_page = place.to_page.after({{1.0, 0.0}, {0.0, 1.0}, low});
        place.viewport = {size.x, size.y};
        if (const auto box = view_box(tree_, element, warnings_)) {
            place.to_page = place.to_page.after(fitted(*box, size, tree_.attribute(element, "preserveAspectRatio")));
            place.viewport = {box->size.x, box->size.y};
        }
        children(element, place);
    }

    const XmlTree& tree_;
    const WalkLimits& limits_;
    DrawingWarnings& warnings_;
    GradientMeans paints_;
    CssSheet sheet_;
    std::map<std::string_view, std::size_t> by_id_;
    std::vector<std::size_t> used_;
    std::size_t visits_ = 0, segments_ = 0, tries_ = 0;
    std::string problem_;
    WalkedDrawing out_;
};

}  // namespace

Result<WalkedDrawing> walk_svg(const XmlTree& tree, const WalkLimits& limits, DrawingWarnings& warnings) {
    return Walk(tree, limits, warnings).run();
}

}  // namespace aerogram::planner
