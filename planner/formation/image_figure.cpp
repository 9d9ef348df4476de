#include <algorithm>
#include <cmath>
#include <memory>

#include "planner/formation/area_figure.hpp"
#include "planner/picture/palette.hpp"
#include "planner/picture/picture.hpp"
#include "planner/sampling/area_sampling.hpp"

namespace aerogram::planner {
namespace {

constexpr double kLargestRaster = 16'000'000.0;  ///< cells
constexpr int kSamplesAcross = 4;                ///< of a cell that is wider than a pixel

/// What is to be seen of a picture. Natural coordinates: pixels, y up, the middle of the box of what is seen at (0, 0).
struct Seen {
    Picture picture;
    std::vector<float> weight;  ///< one a pixel; 0 where nothing is to be seen
    Vec2 low{}, high{};         ///< of the box, pixels, y down
    std::size_t lit = 0;        ///< pixels to be seen

    /// The pixel that holds a place, in (column, row), or nothing.
    [[nodiscard]] std::optional<std::size_t> pixel_at(const Vec2& natural) const {
        const Vec2 middle = 0.5 * (low + high);
        const double column = std::floor(natural.x + middle.x), row = std::floor(middle.y - natural.y);
        if (column < low.x || row < low.y || column >= high.x || row >= high.y) return std::nullopt;
        return static_cast<std::size_t>(row) * picture.width + static_cast<std::size_t>(column);
    }
};

Result<std::shared_ptr<const Seen>> look(Picture picture, const ImageSource& source) {
    auto seen = std::make_shared<Seen>();
    seen->weight.assign(picture.width * picture.height, 0.0F);
    seen->low = Vec2(1e300);
    seen->high = Vec2(-1e300);
    for (std::size_t p = 0; p < seen->weight.size(); ++p) {
        const double bright = luminance(picture.light(p)) * picture.alpha(p);
        if (bright <= 0.0 || bright < source.threshold) continue;
        seen->weight[p] = source.density == ImageDensity::even ? 1.0F : static_cast<float>(bright);
        const Vec2 corner(static_cast<double>(p % picture.width), static_cast<double>(p / picture.width));
        seen->low = glm::min(seen->low, corner);
        seen->high = glm::max(seen->high, corner + Vec2(1.0));
        ++seen->lit;
    }
    if (seen->lit == 0) {
        return Error{ErrorCode::invalid_input,
                     "is dark everywhere: no pixel's luminance times alpha reaches threshold"};
    }
    seen->picture = std::move(picture);
    return std::shared_ptr<const Seen>(std::move(seen));
}

/// The picture's weight by square cells, after stretching.
DensityRaster density_of(const Seen& seen, const Vec2& stretch, std::size_t count) {
    const Vec2 size = (seen.high - seen.low) * stretch;
    DensityRaster raster;
    const double area = static_cast<double>(seen.lit) * stretch.x * stretch.y;
    raster.cell = std::max(std::sqrt(area / static_cast<double>(cells_for(count))),
                           std::max(std::sqrt(size.x * size.y / kLargestRaster), std::max(size.x, size.y) / 1e5));
    raster.across = static_cast<std::size_t>(std::ceil(size.x / raster.cell));
    raster.up = static_cast<std::size_t>(std::ceil(size.y / raster.cell));
    raster.low = -0.5 * raster.cell * Vec2(static_cast<double>(raster.across), static_cast<double>(raster.up));
    raster.mass.resize(raster.across * raster.up);
    const bool fine = raster.cell <= std::min(stretch.x, stretch.y);
    const int samples = fine ? 1 : kSamplesAcross;
    for (std::size_t c = 0; c < raster.mass.size(); ++c) {
        const Vec2 centre = raster.centre(c % raster.across, c / raster.across);
        float sum = 0.0F;
        for (int i = 0; i < samples * samples; ++i) {
            const Vec2 within = (Vec2(i % samples, i / samples) + 0.5) / static_cast<double>(samples) - 0.5;
            if (const auto pixel = seen.pixel_at((centre + raster.cell * within) / stretch)) sum += seen.weight[*pixel];
        }
        raster.mass[c] = sum / static_cast<float>(samples * samples);
    }
    if (raster.total() > 0.0) return raster;
    std::fill(raster.mass.begin(), raster.mass.end(), 1.0F);  // specks that no sample met
    return raster;
}

/// The mean light of what is seen around a place; the window grows until it holds something.
Rgb light_around(const Seen& seen, const Vec2& natural, double reach) {
    const Vec2 middle = 0.5 * (seen.low + seen.high);
    const Vec2 at(natural.x + middle.x, middle.y - natural.y);
    for (;; reach *= 2.0) {
        const auto first = [&](double v, double low) { return std::floor(std::max(v - reach, low)); };
        const auto last = [&](double v, double high) { return std::min(v + reach, high - 1.0); };
        Rgb sum;
        double count = 0.0;
        for (double y = first(at.y, seen.low.y); y <= last(at.y, seen.high.y); y += 1.0) {
            for (double x = first(at.x, seen.low.x); x <= last(at.x, seen.high.x); x += 1.0) {
                const auto p = static_cast<std::size_t>(y) * seen.picture.width + static_cast<std::size_t>(x);
                if (seen.weight[p] <= 0.0F) continue;
                const Rgb light = seen.picture.light(p);
                const double alpha = seen.picture.alpha(p);
                sum = {sum.r + light.r * alpha, sum.g + light.g * alpha, sum.b + light.b * alpha};
                count += 1.0;
            }
        }
        if (count > 0.0) return {sum.r / count, sum.g / count, sum.b / count};
    }
}

}  // namespace

Result<Figure> image_figure(const PartRef& ref, const ImageSource& source, const Run& run) {
    const std::string key = ".image = \"" + source.file.generic_string() + "\": ";
    auto picture = read_picture(source.file);
    if (!picture) return Error{picture.error().code, ref.error(key + picture.error().message).message};
    const auto looked = look(std::move(*picture), source);
    if (!looked) return ref.error(key + looked.error().message);
    const std::shared_ptr<const Seen> seen = *looked;
    const std::size_t count = ref.part.drones;
    const bool even = source.density == ImageDensity::even;
    Figure figure = flat_figure(seen->high - seen->low, [seen, count, even, run](const Vec2& stretch) {
        const DensityRaster density = density_of(*seen, stretch, count);
        return even ? sample_evenly(density, count, run) : sample_density(density, count, run);
    });
    const double reach = 0.35 * std::sqrt(static_cast<double>(seen->lit) / static_cast<double>(count));
    figure.colors_at = [seen, reach, palette = source.palette](const Points& natural) {
        std::vector<Rgb> colors;
        colors.reserve(natural.size());
        for (const Vec3& p : natural) colors.push_back(light_around(*seen, {p.x, p.z}, reach));
        return palette ? reduced(colors, *palette) : colors;
    };
    return figure;
}

}  // namespace aerogram::planner
