#pragma once
#include <optional>
#include <string_view>
#include <vector>

#include "geo/color.hpp"
#include "planner/drawing/path.hpp"

/// The small languages inside SVG's attributes.
namespace aerogram::planner {

struct PathData {
    Path path;
    bool complete = true;  ///< false: the text stops making sense; what came before is in `path`, as SVG asks for
};
/// The `d` attribute, in the path's own units, y down.
[[nodiscard]] PathData parse_path_data(std::string_view text);

/// A list of transforms as one. Absent when it makes no sense.
[[nodiscard]] std::optional<Affine> parse_transforms(std::string_view text);

/// A colour in CSS notation: #rgb, #rrggbb, both with alpha, rgb(), rgba(), hsl(), hsla() and the names.
struct CssColor {
    Rgb light;  ///< linear
    double alpha = 1.0;
};
[[nodiscard]] std::optional<CssColor> parse_color(std::string_view text);
/// "#rrggbb" or one of the 147 names, any case, as 0xrrggbb (sRGB).
[[nodiscard]] std::optional<unsigned> parse_srgb(std::string_view text);

/// Numbers separated by spaces or commas, up to the first thing that is none.
[[nodiscard]] std::vector<double> parse_numbers(std::string_view text);

/// A length in px (96 an inch, em = 16 px); of a percentage this share of `whole`. Absent when it makes no sense.
[[nodiscard]] std::optional<double> parse_length(std::string_view text, double whole);

[[nodiscard]] std::string_view trimmed(std::string_view text);

}  // namespace aerogram::planner
