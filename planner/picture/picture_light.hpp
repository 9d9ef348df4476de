#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "geo/color.hpp"
#include "geo/vec3.hpp"
#include "planner/picture/picture.hpp"

namespace aerogram::planner {

/// Light of a picture: alpha is multiplied into the colour.
struct SeenLight {
    Rgb color;
    double alpha = 0.0;
};

/// A picture to be asked for its mean light around places. Places are in cells from its lower left corner, y up; a cell
/// is a pixel, or a square of pixels averaged where the picture has more than it may keep.
class PictureLight {
  public:
    /// @param most_cells  >= 1: how many cells may be kept, 16 bytes each.
    PictureLight(const Picture& picture, std::size_t most_cells);

    /// Width and height, in cells; not whole where squares of pixels were cut at the right or the bottom.
    [[nodiscard]] Vec2 size() const { return size_; }
    /// The mean over the square of half side `reach` around a place, by area, of what lies inside the picture; nothing
    /// (alpha 0) where none of it does. @param reach  > 0, cells; half a cell blends neighbours linearly.
    [[nodiscard]] SeenLight around(const Vec2& place, double reach) const;

  private:
    std::size_t across_ = 0, down_ = 0;
    Vec2 size_{};
    std::vector<std::array<float, 4>> cells_;  ///< r, g, b times alpha, and alpha; row by row from the top left
};

/// How a picture lies over a box of places, both with the same middle.
struct PictureFit {
    Vec2 cells_per_m{};  ///< or per whatever the box is measured in; 0: everything is in the picture's middle
    double reach = 0.5;  ///< cells: the neighbourhood of one of the places
};
/// Its aspect kept, as small as covers the box. A box without width or height is covered along the other.
/// @param count  >= 1: places, spread over the box.
[[nodiscard]] PictureFit fit_over(const PictureLight& picture, const Vec2& box, std::size_t count);
/// As large as given; of width and height one may be 0, the aspect is then kept; with both 0 as fit_over.
[[nodiscard]] PictureFit fit_size(const PictureLight& picture, const Vec2& size_m, const Vec2& box, std::size_t count);

}  // namespace aerogram::planner
