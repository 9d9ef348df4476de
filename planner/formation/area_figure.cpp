#include "planner/formation/area_figure.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "planner/formation/part_density.hpp"
#include "planner/formation/solid_figure.hpp"
#include "planner/sampling/area_sampling.hpp"
#include "planner/sampling/contour_graph.hpp"
#include "planner/sampling/contour_track.hpp"
#include "planner/sampling/lloyd.hpp"
#include "planner/sampling/slide_apart.hpp"
#include "planner/sampling/stroke_sampling.hpp"

namespace aerogram::planner {
namespace {

constexpr std::size_t kSlideRounds = 200;
constexpr std::size_t kPlacesPerPoint = 16, kPlacesAtLeast = 20'000, kPlacesAtMost = 160'000;  ///< of a coverage
constexpr double kAspectStep = 0.01;                                                           ///< of its logarithm
constexpr double kCloseCorners = 0.7;  ///< spacings; corners nearer than this are one

/// With the middle of its box at (0, 0).
std::shared_ptr<const Region> centred(Region region, Vec2& extent) {
    const Bounds box = bounds_of(region);
    extent = box.size();
    const Vec2 middle = 0.5 * (box.low + box.high);
    for (Contour& contour : region.contours) {
        for (Vec2& p : contour) p -= middle;
    }
    return std::make_shared<const Region>(std::move(region));
}

Region stretched(const Region& region, const Vec2& stretch) {
    Region out = region;
    for (Contour& contour : out.contours) {
        for (Vec2& p : contour) p *= stretch;
    }
    return out;
}

bool nobody(const Region& region, const DensityField& density) {
    const DensityRaster raster = rasterised(region, kPlacesAtMost);
    for (std::size_t c = 0; c < raster.mass.size(); ++c) {
        const Vec2 at = raster.centre(c % raster.across, c / raster.across);
        if (raster.mass[c] > 0.0F && density({at.x, 0.0, at.y}) > 0.0) return false;
    }
    return true;
}

}  // namespace

Figure flat_figure(const Vec2& extent, std::function<std::vector<Vec2>(const Vec2& stretch)> sample) {
    const auto known = std::make_shared<std::map<int, std::vector<Vec2>>>();  // by rounded logarithm of the aspect
    Figure figure;
    figure.extent = {extent.x, 0.0, extent.y};
    figure.points = [known, sample = std::move(sample)](const Vec3& scale) {
        const int step = static_cast<int>(std::lround(std::log(scale.x / scale.z) / kAspectStep));
        const double aspect = std::exp(step * kAspectStep);
        auto found = known->find(step);
        if (found == known->end()) found = known->emplace(step, sample({aspect, 1.0})).first;
        Points points;
        points.reserve(found->second.size());
        for (const Vec2& p : found->second) points.emplace_back(p.x / aspect * scale.x, 0.0, p.y * scale.z);
        return points;
    };
    return figure;
}

std::size_t places_for(std::size_t count) {
    return std::clamp(kPlacesPerPoint * count, kPlacesAtLeast, kPlacesAtMost);
}

std::function<double(const Vec3& scale, const Points& points)> area_coverage(std::shared_ptr<const Region> region,
                                                                             DensityField density) {
    return [region = std::move(region), density = std::move(density)](const Vec3& scale, const Points& points) {
        const std::size_t cells = places_for(points.size());
        DensityRaster area = rasterised(stretched(*region, {scale.x, scale.z}), cells);
        if (density) {
            for (std::size_t c = 0; c < area.mass.size(); ++c) {
                const Vec2 at = area.centre(c % area.across, c / area.across);
                area.mass[c] *= static_cast<float>(std::max(density({at.x / scale.x, 0.0, at.y / scale.z}), 0.0));
            }
            if (area.total() <= 0.0) area = rasterised(stretched(*region, {scale.x, scale.z}), cells);
        }
        std::vector<Vec2> sites;
        sites.reserve(points.size());
        for (const Vec3& p : points) sites.emplace_back(p.x, p.z);
        return mean_distance(sites, area);
    };
}

Result<Figure> area_figure(const PartRef& ref, Region region, AreaStyle style, std::optional<double> outline_share,
                           const Run& run) {
    const std::size_t count = ref.part.drones;
    if (style == AreaStyle::outline) return outlined_figure(std::move(region), count);
    if (style == AreaStyle::solid) return extruded_figure(ref, region, run);
    if (ref.part.density.even()) return filled_figure(std::move(region), count, outline_share, run);
    Vec2 extent{};
    const auto shape = centred(std::move(region), extent);
    const auto density = density_of(ref, {extent.x, 0.0, extent.y});
    if (!density) return density.error();
    if (nobody(*shape, *density)) return ref.error(".density: is 0 all over the shape, so that nobody could be there");
    Figure figure = flat_figure(extent, [shape, count, outline_share, density = *density, run](const Vec2& stretch) {
        const auto there = [&](const Vec2& p) { return density({p.x / stretch.x, 0.0, p.y / stretch.y}); };
        return sample_region(stretched(*shape, stretch), count, outline_share, there, run);
    });
    figure.coverage = area_coverage(shape, *density);
    return figure;
}

Figure filled_figure(Region region, std::size_t count, std::optional<double> outline_share, const Run& run) {
    Vec2 extent{};
    const auto shape = centred(std::move(region), extent);
    Figure figure = flat_figure(extent, [shape, count, outline_share, run](const Vec2& stretch) {
        return sample_region(stretched(*shape, stretch), count, outline_share, run);
    });
    figure.coverage = area_coverage(shape, {});
    return figure;
}

Figure outlined_figure(Region region, std::size_t count) {
    Vec2 extent{};
    const auto shape = centred(std::move(region), extent);
    return flat_figure(extent, [shape, count](const Vec2& stretch) {
        const Region outline = stretched(*shape, stretch);
        double length = 0.0;
        for (const Contour& contour : outline.contours) length += ContourTrack(contour).length();
        const double close = kCloseCorners * length / static_cast<double>(count);
        auto points = sample_strokes(contour_graph(outline, close), Vec2(1.0), count);
        if (!points) points = sample_strokes(contour_graph(outline, 0.0), Vec2(1.0), count);  // dots only
        return slide_apart(outline, std::move(points).value(), length / static_cast<double>(count), kSlideRounds);
    });
}

}  // namespace aerogram::planner
