#pragma once
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "geo/color.hpp"
#include "geo/result.hpp"
#include "planner/mission/mission.hpp"
#include "planner/picture/picture.hpp"

namespace aerogram::planner {

/// What is to be seen of a picture: pixels whose luminance times alpha is not 0 and reaches the source's threshold.
/// Places are in pixels from the upper left corner, y down.
struct SeenPicture {
    Picture picture;
    std::vector<float> weight;  ///< one a pixel: how much it wants drones; 0 where nothing is to be seen
    Vec2 low{}, high{};         ///< of the box around what is seen
    std::size_t lit = 0;        ///< pixels to be seen

    [[nodiscard]] Vec2 middle() const { return 0.5 * (low + high); }
    /// Luminance times alpha.
    [[nodiscard]] double bright(std::size_t pixel) const {
        return luminance(picture.light(pixel)) * picture.alpha(pixel);
    }
    /// The pixel of the box that holds a place.
    [[nodiscard]] std::optional<std::size_t> pixel_at(const Vec2& place) const;
    /// The mean light of the seen pixels in a window of half width `reach` > 0; it grows until it holds one.
    [[nodiscard]] Rgb light_around(const Vec2& place, double reach) const;
    /// The middle of what is seen around a place on the rim: about `distance` inside, less where that is thin.
    [[nodiscard]] Vec2 inwards(const Vec2& place, double distance) const;
};

/// Errors: as read_picture, and invalid_input when nothing is to be seen; without line or file.
Result<std::shared_ptr<const SeenPicture>> seen_picture(const ImageSource& source);

}  // namespace aerogram::planner
