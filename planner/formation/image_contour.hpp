#pragma once
#include <cstddef>
#include <memory>
#include <string>

#include "geo/result.hpp"
#include "planner/formation/seen_picture.hpp"
#include "planner/sampling/region.hpp"

namespace aerogram::planner {

/// The lines around what is seen of a picture.
struct ImageContour {
    Region region;           ///< pixels, y up from the picture's lower edge
    double step = 1.0;       ///< pixels across a cell of the bitmap that was traced
    std::size_t specks = 0;  ///< contours left out as too short for two drones
};

/// Traces at most 1,000 cells across: larger pictures are averaged down first, small ones made finer so that their
/// corners stay. Kept are the longest contours, as many as have room for two drones each at one spacing for all; one
/// at least.
/// @param threshold  as the source's. @param count  drones, >= 1.
/// Cost: 1 s for noise all over. Errors: as contours_of.
Result<ImageContour> image_contour(const SeenPicture& seen, double threshold, std::size_t count);

}  // namespace aerogram::planner
