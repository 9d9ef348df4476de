#pragma once
#include <cmath>

namespace aerogram::planner {

/// How many of n points stand on a shape's boundary so that boundary and inside look equally dense: the root b of
/// n = b + r² b², r = sqrt(f') / b', as the number of points on a boundary grows with the scale and the number inside
/// with its square (paper 002, section 3.6; equation 2, whose print is garbled, derived anew).
/// @param count  n >= 0. @param boundary  b' > 0 points on the boundary at any small sampling unit; also the boundary's
/// length over that unit. @param inside  f' >= 0 points inside at the same unit; also the area over the unit squared.
/// @returns b in [0, n], not rounded; n where there is no inside.
[[nodiscard]] inline double boundary_count(double count, double boundary, double inside) {
    const double squared = inside / (boundary * boundary);
    // (-1 + sqrt(1 + 4 r² n)) / (2 r²), written so that nothing cancels where r is small.
    return 2.0 * count / (1.0 + std::sqrt(1.0 + 4.0 * squared * count));
}

}  // namespace aerogram::planner
