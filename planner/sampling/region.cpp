#include "planner/sampling/region.hpp"

#include <algorithm>
#include <cmath>

#include "geo/contract.hpp"

namespace aerogram::planner {
namespace {

constexpr std::size_t kLinesPerCell = 4;
constexpr std::size_t kCellsAtMost = 16'000'000;

struct Crossing {
    double x = 0.0;
    int turn = 0;  ///< +1 upwards, -1 downwards
};

/// Where the contours cross each scan line, sorted from left to right.
std::vector<std::vector<Crossing>> crossings(const Region& region, const DensityRaster& raster) {
    const double pitch = raster.cell / static_cast<double>(kLinesPerCell);
    std::vector<std::vector<Crossing>> lines(raster.up * kLinesPerCell);
    const auto line_of = [&](double y) { return (y - raster.low.y) / pitch - 0.5; };
    for (const Contour& contour : region.contours) {
        for (std::size_t i = 0; i < contour.size(); ++i) {
            const Vec2 a = contour[i], b = contour[(i + 1) % contour.size()];
            if (a.y == b.y) continue;
            const Vec2 lower = a.y < b.y ? a : b, upper = a.y < b.y ? b : a;
            const double first = std::max(0.0, std::ceil(line_of(lower.y)));
            const double end = std::min(static_cast<double>(lines.size()), std::ceil(line_of(upper.y)));
            for (double l = first; l < end; l += 1.0) {
                const double y = raster.low.y + (l + 0.5) * pitch;
                const double share = (y - lower.y) / (upper.y - lower.y);
                lines[static_cast<std::size_t>(l)].push_back(
                    {lower.x + (upper.x - lower.x) * share, a.y < b.y ? 1 : -1});
            }
        }
    }
    for (auto& line : lines) {
        std::sort(line.begin(), line.end(),
                  [](const Crossing& a, const Crossing& b) { return a.x != b.x ? a.x < b.x : a.turn < b.turn; });
    }
    return lines;
}

/// Adds the stretch from x0 to x1 (in cells) of one scan line.
void cover(float* row, std::size_t across, double x0, double x1) {
    const double weight = 1.0 / static_cast<double>(kLinesPerCell);
    x0 = std::clamp(x0, 0.0, static_cast<double>(across));
    x1 = std::clamp(x1, 0.0, static_cast<double>(across));
    for (auto c = static_cast<std::size_t>(x0); c < across && static_cast<double>(c) < x1; ++c) {
        const double left = std::max(x0, static_cast<double>(c)), right = std::min(x1, static_cast<double>(c + 1));
        row[c] += static_cast<float>(weight * (right - left));
    }
}

void fill(DensityRaster& raster, const Region& region) {
    const auto lines = crossings(region, raster);
    for (std::size_t l = 0; l < lines.size(); ++l) {
        float* row = raster.mass.data() + (l / kLinesPerCell) * raster.across;
        int winding = 0;
        double entered = 0.0;
        for (const Crossing& c : lines[l]) {
            const int before = winding;
            winding += c.turn;
            const double x = (c.x - raster.low.x) / raster.cell;
            if (before == 0) entered = x;
            if (winding == 0) cover(row, raster.across, entered, x);
        }
    }
}

DensityRaster empty_raster(const Bounds& bounds, double cell) {
    DensityRaster raster;
    raster.low = bounds.low;
    raster.cell = cell;
    raster.across = static_cast<std::size_t>(std::ceil(bounds.size().x / cell)) + 1;
    raster.up = static_cast<std::size_t>(std::ceil(bounds.size().y / cell)) + 1;
    raster.mass.assign(raster.across * raster.up, 0.0F);
    return raster;
}

}  // namespace

Bounds bounds_of(const Region& region) {
    Bounds bounds{Vec2(1e300), Vec2(-1e300)};
    for (const Contour& contour : region.contours) {
        for (const Vec2& p : contour) {
            bounds.low = glm::min(bounds.low, p);
            bounds.high = glm::max(bounds.high, p);
        }
    }
    AEROGRAM_REQUIRE(bounds.low.x <= bounds.high.x);
    return bounds;
}

DensityRaster rasterised(const Region& region, std::size_t cells_inside) {
    const Bounds bounds = bounds_of(region);
    const double box = std::max(bounds.size().x, 1e-300) * std::max(bounds.size().y, 1e-300);
    DensityRaster rough = empty_raster(
        bounds, std::max(std::sqrt(box / 20'000.0), std::max(bounds.size().x, bounds.size().y) / 20'000.0));
    fill(rough, region);
    const double area = std::max(rough.total() * rough.cell * rough.cell, box * 1e-6);
    const double finest = std::max(std::sqrt(box / static_cast<double>(kCellsAtMost)),
                                   std::max(bounds.size().x, bounds.size().y) / 100'000.0);
    DensityRaster out = empty_raster(bounds, std::max(std::sqrt(area / static_cast<double>(cells_inside)), finest));
    fill(out, region);
    return out;
}

}  // namespace aerogram::planner
