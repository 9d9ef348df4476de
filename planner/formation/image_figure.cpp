#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "planner/formation/area_figure.hpp"
#include "planner/formation/image_contour.hpp"
#include "planner/formation/part_density.hpp"
#include "planner/formation/seen_picture.hpp"
#include "planner/picture/palette.hpp"
#include "planner/sampling/area_sampling.hpp"
#include "planner/sampling/lloyd.hpp"

namespace aerogram::planner {
namespace {

constexpr double kLargestRaster = 16'000'000.0;  ///< cells
constexpr int kSamplesAcross = 4;                ///< of a cell that is wider than a pixel
constexpr double kPixelsInside = 3.0;            ///< a contour's colours are met this far inside

using Seen = std::shared_ptr<const SeenPicture>;

/// Natural coordinates: pixels, y up, the middle of the box of what is seen at (0, 0).
Vec2 place_of(const SeenPicture& seen, const Vec2& natural) {
    return seen.middle() + Vec2(natural.x, -natural.y);
}

/// The picture's weight by square cells, after stretching.
DensityRaster raster_of(const SeenPicture& seen, const Vec2& stretch, std::size_t cells) {
    const Vec2 size = (seen.high - seen.low) * stretch;
    DensityRaster raster;
    const double area = static_cast<double>(seen.lit) * stretch.x * stretch.y;
    raster.cell = std::max(std::sqrt(area / static_cast<double>(cells)),
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
            const auto pixel = seen.pixel_at(place_of(seen, (centre + raster.cell * within) / stretch));
            if (pixel) sum += seen.weight[*pixel];
        }
        raster.mass[c] = sum / static_cast<float>(samples * samples);
    }
    if (raster.total() > 0.0) return raster;
    std::fill(raster.mass.begin(), raster.mass.end(), 1.0F);  // specks that no sample met
    return raster;
}

/// Times the part's density; as it was where that leaves nothing.
DensityRaster times(DensityRaster raster, const DensityField& density, const Vec2& stretch) {
    if (!density) return raster;
    DensityRaster out = raster;
    for (std::size_t c = 0; c < out.mass.size(); ++c) {
        const Vec2 at = out.centre(c % out.across, c / out.across) / stretch;
        if (out.mass[c] > 0.0F) out.mass[c] *= static_cast<float>(std::max(density({at.x, 0.0, at.y}), 0.0));
    }
    return out.total() > 0.0 ? out : raster;
}

std::vector<Rgb> in_palette(std::vector<Rgb> colors, const std::optional<std::uint32_t>& palette) {
    return palette ? reduced(colors, *palette) : std::move(colors);
}

Result<Figure> filled(const PartRef& ref, const ImageSource& source, const Seen& seen, const Run& run) {
    const std::size_t count = ref.part.drones;
    const Vec2 extent = seen->high - seen->low;
    const auto density = density_of(ref, {extent.x, 0.0, extent.y});
    if (!density) return density.error();
    const bool even = source.density == ImageDensity::even && !*density;
    Figure figure = flat_figure(extent, [seen, count, even, density = *density, run](const Vec2& stretch) {
        const DensityRaster raster = times(raster_of(*seen, stretch, cells_for(count)), density, stretch);
        return even ? sample_evenly(raster, count, run) : sample_density(raster, count, run);
    });
    figure.coverage = [seen, density = *density](const Vec3& scale, const Points& points) {
        const Vec2 stretch(scale.x, scale.z);
        std::vector<Vec2> sites;
        for (const Vec3& p : points) sites.emplace_back(p.x, p.z);
        return mean_distance(sites, times(raster_of(*seen, stretch, places_for(sites.size())), density, stretch));
    };
    const double reach = 0.35 * std::sqrt(static_cast<double>(seen->lit) / static_cast<double>(count));
    figure.colors_at = [seen, reach, palette = source.palette](const Points& natural) {
        std::vector<Rgb> colors;
        colors.reserve(natural.size());
        for (const Vec3& p : natural) colors.push_back(seen->light_around(place_of(*seen, {p.x, p.z}), reach));
        return in_palette(std::move(colors), palette);
    };
    return figure;
}

Result<Figure> contoured(const PartRef& ref, const ImageSource& source, const Seen& seen, const std::string& key) {
    auto contour = image_contour(*seen, source.threshold, ref.part.drones);
    if (!contour) return Error{contour.error().code, ref.error(key + contour.error().message).message};
    const Bounds box = bounds_of(contour->region);
    const Vec2 middle = 0.5 * (box.low + box.high);
    const double inside = kPixelsInside * std::max(contour->step, 1.0);
    Figure figure = outlined_figure(std::move(contour->region), ref.part.drones);
    if (contour->specks > 0)
        figure.note = "left out " + std::to_string(contour->specks) +
                      (contour->specks == 1 ? " contour" : " contours") + " too short for two drones";
    figure.colors_at = [seen, middle, inside, palette = source.palette](const Points& natural) {
        const double height = static_cast<double>(seen->picture.height);
        std::vector<Rgb> colors;
        colors.reserve(natural.size());
        for (const Vec3& p : natural) {
            const Vec2 place(p.x + middle.x, height - (p.z + middle.y));
            colors.push_back(seen->light_around(seen->inwards(place, inside), inside / 3.0));
        }
        return in_palette(std::move(colors), palette);
    };
    return figure;
}

}  // namespace

Result<Figure> image_figure(const PartRef& ref, const ImageSource& source, const Run& run) {
    const std::string key = ".image = \"" + source.file.generic_string() + "\": ";
    const auto seen = seen_picture(source);
    if (!seen) return Error{seen.error().code, ref.error(key + seen.error().message).message};
    return source.contour ? contoured(ref, source, *seen, key) : filled(ref, source, *seen, run);
}

}  // namespace aerogram::planner
