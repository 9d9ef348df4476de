#include "planner/picture/picture_light.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "geo/contract.hpp"

namespace aerogram::planner {
namespace {

/// Half the side of a place's neighbourhood, as a share of the side of the square that is its own.
constexpr double kNeighbourhood = 0.35;

/// How much of cell `index` lies between low and high.
double overlap(double index, double low, double high) {
    return std::min(index + 1.0, high) - std::max(index, low);
}

double reach_of(double cells, std::size_t count) {
    return std::max(0.5, kNeighbourhood * std::sqrt(cells / static_cast<double>(count)));
}

}  // namespace

PictureLight::PictureLight(const Picture& picture, std::size_t most_cells) {
    AEROGRAM_REQUIRE(most_cells >= 1 && picture.width > 0 && picture.height > 0, most_cells);
    const auto cells_at = [&](std::size_t side) {
        return ((picture.width + side - 1) / side) * ((picture.height + side - 1) / side);
    };
    std::size_t side = 1;
    while (cells_at(side) > most_cells) ++side;
    across_ = (picture.width + side - 1) / side;
    down_ = (picture.height + side - 1) / side;
    size_ = Vec2(static_cast<double>(picture.width), static_cast<double>(picture.height)) / static_cast<double>(side);
    cells_.resize(across_ * down_);
    for (std::size_t c = 0; c < cells_.size(); ++c) {
        const std::size_t left = c % across_ * side, top = c / across_ * side;
        const std::size_t right = std::min(left + side, picture.width), bottom = std::min(top + side, picture.height);
        std::array<double, 4> sum{};
        for (std::size_t y = top; y < bottom; ++y) {
            for (std::size_t x = left; x < right; ++x) {
                const std::size_t pixel = y * picture.width + x;
                const Rgb light = picture.light(pixel);
                const double alpha = picture.alpha(pixel);
                sum = {sum[0] + alpha * light.r, sum[1] + alpha * light.g, sum[2] + alpha * light.b, sum[3] + alpha};
            }
        }
        const auto pixels = static_cast<double>((right - left) * (bottom - top));
        for (std::size_t i = 0; i < 4; ++i) cells_[c][i] = static_cast<float>(sum[i] / pixels);
    }
}

SeenLight PictureLight::around(const Vec2& place, double reach) const {
    const Vec2 from_top(place.x, size_.y - place.y);
    const Vec2 low = glm::max(from_top - reach, Vec2(0.0)), high = glm::min(from_top + reach, size_);
    if (!(low.x < high.x && low.y < high.y)) return {};
    SeenLight out;
    const auto last_row = std::min(static_cast<std::size_t>(std::ceil(high.y)), down_);
    const auto last_column = std::min(static_cast<std::size_t>(std::ceil(high.x)), across_);
    for (auto row = static_cast<std::size_t>(low.y); row < last_row; ++row) {
        const double height = overlap(static_cast<double>(row), low.y, high.y);
        for (auto column = static_cast<std::size_t>(low.x); column < last_column; ++column) {
            const double area = height * overlap(static_cast<double>(column), low.x, high.x);
            const std::array<float, 4>& cell = cells_[row * across_ + column];
            out.color = {out.color.r + area * cell[0], out.color.g + area * cell[1], out.color.b + area * cell[2]};
            out.alpha += area * cell[3];
        }
    }
    const double area = (high.x - low.x) * (high.y - low.y);
    const auto mean = [area](double sum) { return std::min(1.0, sum / area); };  // areas are rounded
    return {{mean(out.color.r), mean(out.color.g), mean(out.color.b)}, mean(out.alpha)};
}

PictureFit fit_over(const PictureLight& picture, const Vec2& box, std::size_t count) {
    const Vec2 size = picture.size();
    const double wide = box.x > 0.0 ? size.x / box.x : 0.0, high = box.y > 0.0 ? size.y / box.y : 0.0;
    const double cells_per_m = wide > 0.0 && high > 0.0 ? std::min(wide, high) : std::max(wide, high);
    return {Vec2(cells_per_m), reach_of(box.x * box.y * cells_per_m * cells_per_m, count)};
}

PictureFit fit_size(const PictureLight& picture, const Vec2& size_m, const Vec2& box, std::size_t count) {
    if (size_m.x <= 0.0 && size_m.y <= 0.0) return fit_over(picture, box, count);
    const Vec2 size = picture.size();
    const double wide = size_m.x > 0.0 ? size.x / size_m.x : size.y / size_m.y;
    const double high = size_m.y > 0.0 ? size.y / size_m.y : wide;
    const Vec2 seen = glm::min(Vec2(box.x * wide, box.y * high), size);
    return {{wide, high}, reach_of(seen.x * seen.y, count)};
}

}  // namespace aerogram::planner
