#include "planner/formation/part_density.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "planner/formation/sizing.hpp"
#include "planner/picture/picture.hpp"

namespace aerogram::planner {
namespace {

constexpr std::size_t kFinest = 1024;  ///< cells of a map along its longer side

/// Luminance times alpha by cells, row by row from the top left.
struct Map {
    std::size_t across = 0, down = 0;
    std::vector<float> light;

    [[nodiscard]] double cell(std::ptrdiff_t column, std::ptrdiff_t row) const {
        const auto c = std::clamp<std::ptrdiff_t>(column, 0, static_cast<std::ptrdiff_t>(across) - 1);
        const auto r = std::clamp<std::ptrdiff_t>(row, 0, static_cast<std::ptrdiff_t>(down) - 1);
        return static_cast<double>(light[static_cast<std::size_t>(r) * across + static_cast<std::size_t>(c)]);
    }

    /// Between the middles of four cells. @param at  shares of the width from the left and of the height from the top.
    [[nodiscard]] double at(const Vec2& share) const {
        const Vec2 p = glm::clamp(share, 0.0, 1.0) * Vec2(static_cast<double>(across), static_cast<double>(down)) - 0.5;
        const Vec2 whole = glm::floor(p), part = p - whole;
        const auto c = static_cast<std::ptrdiff_t>(whole.x), r = static_cast<std::ptrdiff_t>(whole.y);
        const double upper = cell(c, r) + (cell(c + 1, r) - cell(c, r)) * part.x;
        const double lower = cell(c, r + 1) + (cell(c + 1, r + 1) - cell(c, r + 1)) * part.x;
        return upper + (lower - upper) * part.y;
    }
};

/// The picture's light, averaged over squares of pixels where it has more of them than a map needs.
Map map_of(const Picture& picture) {
    const std::size_t step = (std::max(picture.width, picture.height) + kFinest - 1) / kFinest;
    Map map{(picture.width + step - 1) / step, (picture.height + step - 1) / step, {}};
    map.light.reserve(map.across * map.down);
    for (std::size_t row = 0; row < picture.height; row += step) {
        for (std::size_t column = 0; column < picture.width; column += step) {
            double sum = 0.0, count = 0.0;
            for (std::size_t y = row; y < std::min(row + step, picture.height); ++y) {
                for (std::size_t x = column; x < std::min(column + step, picture.width); ++x, count += 1.0) {
                    const std::size_t pixel = y * picture.width + x;
                    sum += luminance(picture.light(pixel)) * picture.alpha(pixel);
                }
            }
            map.light.push_back(static_cast<float>(sum / count));
        }
    }
    return map;
}

Result<DensityField> image_density(const PartRef& ref, const std::filesystem::path& file, const Vec3& extent) {
    const std::string key = ".density = \"" + file.generic_string() + "\": ";
    const auto picture = read_picture(file);
    if (!picture) return Error{picture.error().code, ref.error(key + picture.error().message).message};
    auto map = std::make_shared<const Map>(map_of(*picture));
    if (std::none_of(map->light.begin(), map->light.end(), [](float light) { return light > 0.0F; }))
        return ref.error(key + "is black everywhere, and black means nobody");
    return DensityField([map, extent](const Vec3& p) {
        const double across = extent.x > 0.0 ? p.x / extent.x + 0.5 : 0.5;
        const double down = extent.z > 0.0 ? 0.5 - p.z / extent.z : 0.5;
        return map->at({across, down});
    });
}

double brushed(const std::vector<BrushStroke>& brush, const Vec2& at_m) {
    double density = 1.0;
    for (const BrushStroke& stroke : brush) {
        const Vec2 away = (at_m - stroke.center_m) / stroke.radius_m;
        const double within = 1.0 - glm::dot(away, away);
        if (within > 0.0) density *= 1.0 + (stroke.density - 1.0) * within * within;
    }
    return density;
}

}  // namespace

Result<DensityField> density_of(const PartRef& ref, const Vec3& extent) {
    const DensityMap& asked = ref.part.density;
    DensityField field;
    if (asked.image) {
        auto image = image_density(ref, *asked.image, extent);
        if (!image) return image.error();
        field = std::move(*image);
    }
    if (asked.brush.empty()) return field;
    const auto scale = asked_scale(extent, ref.part.size);
    if (!scale) return ref.error(".brush: is in metres, so the part needs size_m");
    return DensityField([field, brush = asked.brush, scale = *scale](const Vec3& p) {
        return (field ? field(p) : 1.0) * brushed(brush, {p.x * scale.x, p.z * scale.z});
    });
}

}  // namespace aerogram::planner
