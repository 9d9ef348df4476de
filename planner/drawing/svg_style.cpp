#include "planner/drawing/svg_style.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "planner/drawing/svg_grammar.hpp"

namespace aerogram::planner {
namespace {

constexpr std::size_t kWarningsAtMost = 50;
constexpr std::array<std::string_view, 23> kProperties{
    "fill",       "stroke",           "stroke-width", "fill-rule",      "fill-opacity", "stroke-opacity",
    "opacity",    "display",          "color",        "visibility",     "clip-path",    "clip-rule",
    "mask",       "filter",           "marker",       "stop-color",     "marker-start", "marker-mid",
    "marker-end", "stroke-dasharray", "stop-opacity", "mix-blend-mode", "paint-order"};

bool is_property(std::string_view name) {
    return std::find(kProperties.begin(), kProperties.end(), name) != kProperties.end();
}

std::string shortened(std::string_view text) {
    return std::string(text.substr(0, 40)) + (text.size() > 40 ? "..." : "");
}

/// One element's cascade.
class Cascade {
  public:
    Cascade(ElementStyle& style, const ElementStyle& parent, std::size_t line, double diagonal,
            DrawingWarnings& warnings)
        : style_(style), parent_(parent), line_(line), diagonal_(diagonal), warnings_(warnings) {}

    void set(std::string_view name, std::string_view value) {
        value = trimmed(value);
        if (value.empty()) return;
        const bool inherit = value == "inherit";
        if (name == "fill") return inherit ? void(style_.fill = parent_.fill) : paint(name, value, style_.fill);
        if (name == "stroke") return inherit ? void(style_.stroke = parent_.stroke) : paint(name, value, style_.stroke);
        if (name == "color") return inherit ? void(style_.color = parent_.color) : color(value);
        if (name == "stroke-width") return inherit ? void(style_.stroke_width = parent_.stroke_width) : width(value);
        if (name == "fill-rule") return void(style_.evenodd = inherit ? parent_.evenodd : value == "evenodd");
        if (name == "clip-rule") return void(style_.clip_evenodd = inherit ? parent_.clip_evenodd : value == "evenodd");
        if (name == "visibility") return void(style_.visible = inherit ? parent_.visible : value == "visible");
        if (name == "fill-opacity") return share(value, parent_.fill_opacity, style_.fill_opacity);
        if (name == "stroke-opacity") return share(value, parent_.stroke_opacity, style_.stroke_opacity);
        if (name == "stroke-dasharray") return void(style_.dashed = inherit ? parent_.dashed : value != "none");
        if (name == "opacity") return share(value, 1.0, opacity_);
        if (name == "display") return void(style_.display = inherit ? parent_.display : value != "none");
        if (name == "stop-opacity") return share(value, parent_.stop_opacity, style_.stop_opacity);
        rare(name, value);
    }

    void finish() { style_.shown = parent_.shown * opacity_; }

  private:
    void rare(std::string_view name, std::string_view value) {
        const bool some = value != "none";
        if (name == "clip-path") style_.clip = link_target(value);
        if (name == "mask") style_.masked = some;
        if (name == "filter") style_.filtered = some;
        if (name.starts_with("marker")) style_.marked = some;
        if (name != "stop-color") return;
        if (value == "currentColor") {
            style_.stop = style_.color;
        } else if (const auto light = parse_color(value)) {
            style_.stop = light->light;
            style_.stop_opacity *= light->alpha;
        }
    }

    void wrong(std::string_view name, std::string_view value) {
        warnings_.add(line_,
                      std::string(name) + " = \"" + shortened(value) + "\" is not understood and counts for nothing");
    }

    void paint(std::string_view name, std::string_view value, SvgPaint& out) {
        if (value == "none") return void(out = {});
        if (value == "currentColor" || value == "currentcolor")
            return void(out = {SvgPaint::Kind::current, {}, 1.0, false, {}});
        if (value.starts_with("url(")) {
            const std::size_t end = value.find(')');
            SvgPaint link{SvgPaint::Kind::link, {}, 1.0, false, link_target(value)};
            if (end != std::string_view::npos) {
                const std::string_view rest = trimmed(value.substr(end + 1));
                if (const auto light = parse_color(rest); light && !rest.empty()) {
                    link.light = light->light;
                    link.fallback = true;
                }
            }
            return void(out = link);
        }
        const std::string_view plain = value.substr(0, value.find(" icc-color"));
        if (const auto light = parse_color(plain)) {
            out = {SvgPaint::Kind::color, light->light, light->alpha, false, {}};
        } else {
            wrong(name, value);
        }
    }

    void color(std::string_view value) {
        if (const auto light = parse_color(value)) {
            style_.color = light->light;
        } else if (value != "currentColor") {
            wrong("color", value);
        }
    }

    void width(std::string_view value) {
        if (const auto length = parse_length(value, diagonal_); length && *length >= 0.0) {
            style_.stroke_width = *length;
        } else {
            wrong("stroke-width", value);
        }
    }

    void share(std::string_view value, double inherited, double& out) {
        if (value == "inherit") return void(out = inherited);
        if (const auto number = parse_length(value, 1.0)) out = std::clamp(*number, 0.0, 1.0);
    }

    ElementStyle& style_;
    const ElementStyle& parent_;
    std::size_t line_;
    double diagonal_, opacity_ = 1.0;
    DrawingWarnings& warnings_;
};

}  // namespace

void DrawingWarnings::add(std::size_t line, const std::string& what) {
    const auto found = seen_.find(what);
    if (found == seen_.end() && seen_.size() >= kWarningsAtMost) {
        ++more_;
        return;
    }
    Seen& seen = seen_[what];
    if (seen.times++ == 0 || line < seen.line) seen.line = line;
}

std::vector<std::string> DrawingWarnings::messages() const {
    std::vector<std::pair<std::size_t, std::string>> by_line;
    for (const auto& [what, seen] : seen_) {
        by_line.emplace_back(seen.line, "line " + std::to_string(seen.line) + ": " + what +
                                            (seen.times > 1 ? " (" + std::to_string(seen.times) + " times)" : ""));
    }
    std::sort(by_line.begin(), by_line.end());
    std::vector<std::string> out;
    for (auto& [line, message] : by_line) out.push_back(std::move(message));
    if (more_ > 0) out.push_back("and " + std::to_string(more_) + " more");
    return out;
}

std::string_view link_target(std::string_view value) {
    value = trimmed(value);
    if (!value.starts_with("url(")) return {};
    std::string_view inside = trimmed(value.substr(4, value.find(')') - 4));
    if (inside.size() >= 2 && (inside.front() == '"' || inside.front() == '\'')) {
        inside = inside.substr(1, inside.size() - 2);
    }
    return inside.starts_with('#') ? inside.substr(1) : std::string_view{};
}

ElementStyle style_of(const XmlTree& tree, std::size_t element, const ElementStyle& parent, const CssSheet& sheet,
                      double diagonal, DrawingWarnings& warnings, std::size_t& tries) {
    ElementStyle style = parent;
    style.display = true;
    style.filtered = style.masked = style.marked = false;
    style.clip = {};
    style.stop.reset();
    style.stop_opacity = 1.0;
    Cascade cascade(style, parent, tree.elements[element].line, diagonal, warnings);
    std::vector<Declaration> declared;
    for (const XmlAttribute& a : tree.attributes_of(element)) {
        if (is_property(a.name)) declared.push_back({a.name, a.value, false});
    }
    const std::size_t own = declared.size();
    if (!sheet.empty()) {
        const auto ruled = sheet.declarations_for(tree, element, tries);
        declared.insert(declared.end(), ruled.begin(), ruled.end());
    }
    const auto inline_style = parse_declarations(tree.attribute(element, "style"));
    declared.insert(declared.end(), inline_style.begin(), inline_style.end());
    std::stable_sort(declared.begin() + static_cast<std::ptrdiff_t>(own), declared.end(),
                     [](const Declaration& a, const Declaration& b) { return !a.important && b.important; });
    for (const Declaration& d : declared) {
        if (d.name == "color") cascade.set(d.name, d.value);  // before those that use it
    }
    for (const Declaration& d : declared) {
        if (d.name != "color") cascade.set(d.name, d.value);
    }
    cascade.finish();
    return style;
}

}  // namespace aerogram::planner
