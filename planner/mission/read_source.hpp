#pragma once
#include <optional>
#include <string_view>

#include "planner/mission/sections.hpp"

namespace aerogram::planner {

/// What size_m may look like: width and height; these and depth_m; all three; unknown where the source itself is wrong,
/// so that one slip is told once.
enum class Form { flat, extruded, solid, unknown };
struct Sourced {
    Source source = TextSource{};
    Form form = Form::unknown;
    bool dense = false;  ///< has an inside that a density map can weigh
    std::optional<Animation> animation = std::nullopt;
};

/// The one source of a keyframe or part.
Sourced read_source(TableReader& in, bool is_part);
Sourced read_shape(TableReader& in);
/// `style = "surface"`, "volume" or "edges".
std::optional<SolidStyle> read_solid_style(TableReader& in);

}  // namespace aerogram::planner
