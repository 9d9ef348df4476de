#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geo/color.hpp"
#include "planner/drawing/css_sheet.hpp"
#include "planner/drawing/xml_tree.hpp"

namespace aerogram::planner {

/// What a reader left out, one message a kind with its first line and how often.
class DrawingWarnings {
  public:
    void add(std::size_t line, const std::string& what);
    /// "line 12: what (3 times)", in the order of first lines.
    [[nodiscard]] std::vector<std::string> messages() const;

  private:
    struct Seen {
        std::size_t line = 0, times = 0;
    };
    std::map<std::string, Seen> seen_;
    std::size_t more_ = 0;
};

/// The value of `fill` or `stroke`.
struct SvgPaint {
    enum class Kind : std::uint8_t { none, color, current, link };
    Kind kind = Kind::none;
    Rgb light;  ///< color, and of a link what counts if it leads nowhere
    double alpha = 1.0;
    bool fallback = false;  ///< of a link: `light` is given
    std::string_view link;  ///< without '#'
};

/// What an element's shapes look like. Properties up to `dashed` are inherited.
struct ElementStyle {
    SvgPaint fill{SvgPaint::Kind::color, {}, 1.0, false, {}};
    SvgPaint stroke;
    Rgb color;
    double stroke_width = 1.0;
    double fill_opacity = 1.0, stroke_opacity = 1.0;
    bool evenodd = false, clip_evenodd = false, visible = true, dashed = false;
    double shown = 1.0;  ///< product of the opacities from the root
    bool display = true;
    bool filtered = false, masked = false, marked = false;
    std::string_view clip;  ///< id of a clipPath; empty: none
    std::optional<Rgb> stop;
    double stop_opacity = 1.0;
};

/// The style of an element inside one of style `parent`: presentation attributes, then the sheet's rules, then its own
/// style attribute, then whatever is !important. @param diagonal  what percentages of widths are of.
/// @param tries  as CssSheet's.
[[nodiscard]] ElementStyle style_of(const XmlTree& tree, std::size_t element, const ElementStyle& parent,
                                    const CssSheet& sheet, double diagonal, DrawingWarnings& warnings,
                                    std::size_t& tries);

/// "url(#name)" -> "name"; empty when it is no link into the file.
[[nodiscard]] std::string_view link_target(std::string_view value);

}  // namespace aerogram::planner
