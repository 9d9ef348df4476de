#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geo/color.hpp"
#include "geo/result.hpp"
#include "geo/vec3.hpp"

namespace aerogram::planner {

/// What a formation csv holds: a static Skybrush formation `Name,x_m,y_m,z_m[,Red,Green,Blue]`.
struct CsvPoints {
    Points points_m;
    std::vector<Rgb> colors;  ///< one a point, or empty
};

/// Reads a formation csv: a header line, then one drone a line. Columns may come in any order; Name may be missing; x,
/// y, z may be written for x_m, y_m, z_m; colours are linear lamp values 0-255. Fields may be quoted; blank lines are
/// skipped.
/// @param file  names the text in messages.
/// Errors: invalid_input with every wrong line, one problem a line, as "file:line: what".
Result<CsvPoints> parse_csv_points(std::string_view text, const std::string& file);

}  // namespace aerogram::planner
