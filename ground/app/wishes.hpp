#pragma once
#include <optional>
#include <string>

#include "geo/result.hpp"
#include "geo/show_frame.hpp"
#include "planner/mission/export_wishes.hpp"

/// Words of the command line as values.
namespace aerogram::ground {

/// What was typed instead of a mission's [export]; empty words leave `wishes` as they are.
struct TypedWishes {
    std::string start_utc, timing, autopilot, vviz;
};
/// Errors: invalid_input naming the option and what it accepts.
Status take_wishes(const TypedWishes& typed, planner::ExportWishes& wishes);

/// "35.6586,139.7454,40,20": latitude and longitude in degrees, metres above the ellipsoid, heading in degrees; empty:
/// absent. A fifth number is the geoid's undulation. Errors: invalid_input.
Result<std::optional<geo::ShowOrigin>> parse_origin(const std::string& text);

/// Errors: invalid_input for a name that is neither a format's nor a paper's, listing those that there are.
Status check_format_names(const std::vector<std::string>& names);

}  // namespace aerogram::ground
