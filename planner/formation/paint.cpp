#include "planner/formation/paint.hpp"

#include <algorithm>
#include <glm/common.hpp>

#include "geo/random.hpp"
#include "planner/formation/color_ramp.hpp"
#include "planner/picture/picture_light.hpp"

namespace aerogram::planner {
namespace {

constexpr std::size_t kMostCells = 4'000'000;  ///< of a projected picture
/// Places this much nearer to the eyes than the middle, or behind them, are seen as if they were so near.
constexpr double kNearest = 1e-3;

struct Bounds {
    Vec3 low{}, high{};
    [[nodiscard]] Vec3 middle() const { return 0.5 * (low + high); }
};

Bounds bounds_of(const Points& points) {
    Bounds box{points.front(), points.front()};
    for (const Vec3& p : points) {
        box.low = glm::min(box.low, p);
        box.high = glm::max(box.high, p);
    }
    return box;
}

std::vector<Rgb> graded(const Gradient& gradient, const Points& points_m) {
    AEROGRAM_REQUIRE(gradient.radial || glm::length(gradient.direction) > 0.0);
    const Vec3 middle_m = bounds_of(points_m).middle();
    const Vec3 direction = gradient.radial ? Vec3{} : glm::normalize(gradient.direction);
    std::vector<double> way_m;
    way_m.reserve(points_m.size());
    for (const Vec3& p : points_m)
        way_m.push_back(gradient.radial ? glm::distance(p, middle_m) : glm::dot(p - middle_m, direction));
    const auto [low, high] = std::minmax_element(way_m.begin(), way_m.end());
    const double begin_m = gradient.radial ? 0.0 : *low, length_m = *high - begin_m;
    std::vector<Rgb> colors;
    colors.reserve(points_m.size());
    for (const double way : way_m)
        colors.push_back(ramp_color(gradient.colors, length_m > 0.0 ? (way - begin_m) / length_m : 0.0));
    return colors;
}

std::vector<Rgb> dealt(const Palette& palette, std::size_t count, std::uint64_t seed) {
    AEROGRAM_REQUIRE(!palette.colors.empty());
    Random random(seed);
    std::vector<Rgb> colors;
    colors.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t which = palette.by == PaletteBy::slot
                                      ? i % palette.colors.size()
                                      : static_cast<std::size_t>(random.below(palette.colors.size()));
        colors.push_back(palette.colors[which]);
    }
    return colors;
}

/// Places as they are seen from the seat: to the right and upwards on a plane, at distance 1, that faces the middle.
std::vector<Vec2> seen_from(const Vec3& seat_m, const Points& points_m) {
    const Vec3 to_middle = bounds_of(points_m).middle() - seat_m;
    const double away_m = glm::length(to_middle);
    const Vec3 ahead = away_m > 0.0 ? to_middle / away_m : Vec3{0, 1, 0};
    const Vec3 level{ahead.y, -ahead.x, 0.0};  // ahead x up
    const Vec3 right = glm::length(level) > 1e-9 ? glm::normalize(level) : Vec3{1, 0, 0};
    const Vec3 up = glm::cross(right, ahead);
    std::vector<Vec2> seen;
    seen.reserve(points_m.size());
    for (const Vec3& p : points_m) {
        const Vec3 d = p - seat_m;
        const double depth_m = std::max({glm::dot(d, ahead), kNearest * away_m, 1e-9});
        seen.emplace_back(glm::dot(d, right) / depth_m, glm::dot(d, up) / depth_m);
    }
    return seen;
}

Result<std::vector<Rgb>> projected(const ProjectedPicture& paint, const Points& points_m, const Vec3& seat_m) {
    const auto read = read_picture(paint.image);
    if (!read) return read.error();
    const PictureLight picture(*read, kMostCells);
    const std::vector<Vec2> seen = seen_from(seat_m, points_m);
    Vec2 low = seen.front(), high = seen.front();
    for (const Vec2& p : seen) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const PictureFit fit = fit_over(picture, high - low, seen.size());
    std::vector<Rgb> colors;
    colors.reserve(seen.size());
    for (const Vec2& p : seen) {
        const Vec2 at = 0.5 * picture.size() + fit.cells_per_m * (p - 0.5 * (low + high));
        colors.push_back(picture.around(at, fit.reach).color);
    }
    return colors;
}

}  // namespace

Result<std::vector<Rgb>> painted(const Paint& paint, const Points& points_m, const Vec3& seat_m, std::uint64_t seed) {
    if (points_m.empty()) return std::vector<Rgb>{};
    if (const auto* color = std::get_if<Rgb>(&paint)) return std::vector<Rgb>(points_m.size(), *color);
    if (const auto* gradient = std::get_if<Gradient>(&paint)) return graded(*gradient, points_m);
    if (const auto* palette = std::get_if<Palette>(&paint)) return dealt(*palette, points_m.size(), seed);
    return projected(std::get<ProjectedPicture>(paint), points_m, seat_m);
}

}  // namespace aerogram::planner
