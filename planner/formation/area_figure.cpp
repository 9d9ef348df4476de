#include "planner/formation/area_figure.hpp"

#include <cmath>
#include <map>
#include <memory>

#include "planner/sampling/area_sampling.hpp"
#include "planner/sampling/contour_graph.hpp"
#include "planner/sampling/contour_track.hpp"
#include "planner/sampling/slide_apart.hpp"
#include "planner/sampling/stroke_sampling.hpp"

namespace aerogram::planner {
namespace {

constexpr std::size_t kSlideRounds = 200;
constexpr double kAspectStep = 0.01;   ///< of its logarithm
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

Figure filled_figure(Region region, std::size_t count, std::optional<double> outline_share, const Run& run) {
    Vec2 extent{};
    const auto shape = centred(std::move(region), extent);
    return flat_figure(extent, [shape, count, outline_share, run](const Vec2& stretch) {
        return sample_region(stretched(*shape, stretch), count, outline_share, run);
    });
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
