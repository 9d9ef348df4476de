#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geo/result.hpp"
#include "geo/vec3.hpp"

namespace aerogram::planner {

/// A grid of pads on the ground, show frame: row by row, row 1 nearest the audience (smallest y), each row left to
/// right (x ascending), the whole centred on center_m. @param count  the first `count` of rows x columns are returned.
struct PadGrid {
    std::size_t rows = 1, columns = 1;
    double spacing_m = 0.0;
    Vec2 center_m{};
};
[[nodiscard]] Points grid_pads(const PadGrid& grid, std::size_t count);

/// The pads of a CSV file with the header x_m,y_m or x_m,y_m,z_m, show frame, metres, in file order.
/// Errors: invalid_input with every bad line as "file:line: what"; io when it cannot be read.
Result<Points> read_pads_csv(const std::filesystem::path& file);

/// The two pads that are closest in the separation metric and nearer than `limit_m`; the lower numbers on
/// ties (any of them at distance 0).
struct TightPads {
    std::size_t first = 0, second = 0;
    double distance_m = 0.0;
};
[[nodiscard]] std::optional<TightPads> find_tight_pads(const Points& pads_m, const SeparationMetric& metric,
                                                       double limit_m);

}  // namespace aerogram::planner
