#pragma once
#include <cstddef>
#include <vector>

#include "geo/color.hpp"

namespace aerogram::planner {

/// The colours replaced by at most `most` of them: median cut (Heckbert 1982), then k-means, in linear light.
/// Properties: (1) at most `most` different colours come back (2) with no more than `most` different ones nothing
/// changes (3) deterministic. @param most  >= 1.
[[nodiscard]] std::vector<Rgb> reduced(const std::vector<Rgb>& colors, std::size_t most);

}  // namespace aerogram::planner
