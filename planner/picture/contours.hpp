#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geo/result.hpp"
#include "planner/sampling/region.hpp"

namespace aerogram::planner {

/// Pixels that are set or not, row by row from the top left.
struct Bitmap {
    std::size_t width = 0, height = 0;
    std::vector<std::uint8_t> set;  ///< one a pixel, 0 or 1
};

/// Smooth outlines around a bitmap's set pixels, corners kept (Potrace, Selinger 2003). Unit: pixels, y up from the
/// picture's lower edge. Areas and holes of at most `speck` pixels are left out, but not all of them.
/// @param bitmap  with a set pixel, at most 4 million pixels.
/// Properties: (1) within a pixel of the border between set and clear pixels, specks aside (2) holes run against the
/// contours around them (3) deterministic. Errors: io when there is not enough memory.
Result<Region> contours_of(const Bitmap& bitmap, std::size_t speck);

}  // namespace aerogram::planner
