#include "planner/formation/seen_picture.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace aerogram::planner {
namespace {

/// Calls visit(pixel, middle) for the seen pixels that a window around a place touches.
template <class Visit>
void for_each_seen(const SeenPicture& seen, const Vec2& place, double reach, const Visit& visit) {
    const auto first = [&](double v, double low) { return std::floor(std::max(v - reach, low)); };
    const auto last = [&](double v, double high) { return std::min(v + reach, high - 1.0); };
    for (double y = first(place.y, seen.low.y); y <= last(place.y, seen.high.y); y += 1.0) {
        for (double x = first(place.x, seen.low.x); x <= last(place.x, seen.high.x); x += 1.0) {
            const auto p = static_cast<std::size_t>(y) * seen.picture.width + static_cast<std::size_t>(x);
            if (seen.weight[p] > 0.0F) visit(p, Vec2(x + 0.5, y + 0.5));
        }
    }
}

}  // namespace

std::optional<std::size_t> SeenPicture::pixel_at(const Vec2& place) const {
    const Vec2 p = glm::floor(place);
    if (p.x < low.x || p.y < low.y || p.x >= high.x || p.y >= high.y) return std::nullopt;
    return static_cast<std::size_t>(p.y) * picture.width + static_cast<std::size_t>(p.x);
}

Rgb SeenPicture::light_around(const Vec2& place, double reach) const {
    for (;; reach *= 2.0) {
        Rgb sum;
        double count = 0.0;
        for_each_seen(*this, place, reach, [&](std::size_t p, const Vec2&) {
            const Rgb light = picture.light(p);
            const double alpha = picture.alpha(p);
            sum = {sum.r + light.r * alpha, sum.g + light.g * alpha, sum.b + light.b * alpha};
            count += 1.0;
        });
        if (count > 0.0) return {sum.r / count, sum.g / count, sum.b / count};
    }
}

Vec2 SeenPicture::inwards(const Vec2& place, double distance) const {
    Vec2 sum{};
    double count = 0.0;
    // Of a half plane in a square window the middle is half the window's half width inside.
    for_each_seen(*this, place, 2.0 * distance, [&](std::size_t, const Vec2& middle) {
        sum += middle;
        count += 1.0;
    });
    return count > 0.0 ? sum / count : place;
}

Result<std::shared_ptr<const SeenPicture>> seen_picture(const ImageSource& source) {
    auto picture = read_picture(source.file);
    if (!picture) return picture.error();
    auto seen = std::make_shared<SeenPicture>();
    seen->picture = std::move(*picture);
    const std::size_t width = seen->picture.width;
    seen->weight.assign(width * seen->picture.height, 0.0F);
    seen->low = Vec2(1e300);
    seen->high = Vec2(-1e300);
    for (std::size_t p = 0; p < seen->weight.size(); ++p) {
        const double bright = seen->bright(p);
        if (bright <= 0.0 || bright < source.threshold) continue;
        seen->weight[p] = source.density == ImageDensity::even ? 1.0F : static_cast<float>(bright);
        const Vec2 corner(static_cast<double>(p % width), static_cast<double>(p / width));
        seen->low = glm::min(seen->low, corner);
        seen->high = glm::max(seen->high, corner + Vec2(1.0));
        ++seen->lit;
    }
    if (seen->lit == 0) {
        return Error{ErrorCode::invalid_input,
                     "is dark everywhere: no pixel's luminance times alpha reaches threshold"};
    }
    return std::shared_ptr<const SeenPicture>(std::move(seen));
}

}  // namespace aerogram::planner
