#include "planner/sampling/area_sampling.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geo/contract.hpp"
#include "planner/sampling/lloyd.hpp"
#include "planner/sampling/outline_points.hpp"
#include "planner/sampling/push_apart.hpp"

namespace aerogram::planner {
namespace {

constexpr std::size_t kCellsPerPoint = 64, kCellsAtLeast = 40'000, kCellsAtMost = 1'300'000;
constexpr std::size_t kLloydRounds = 20, kJumpingRounds = 7, kPushRounds = 240, kPushRoundsAtMost = 1000;
constexpr std::size_t kPushWork = 1'000'000;     ///< points x rounds that may be spent when there are few points
constexpr double kHexagon = 0.8660254037844386;  ///< area of a lattice's cell at spacing 1
constexpr double kMostCellsByDensity = 3e6;      ///< where it gathers in a small part of the region
constexpr double kReached = 0.86;  ///< share of the triangular lattice's density that relaxed points reach

/// The spacing at which outline and inside together hold `count` points, and the outline's points then.
std::vector<Vec2> balanced_outline(const Region& region, double area, std::size_t count) {
    double low = 0.0, high = 4.0 * std::sqrt(area / (kHexagon * static_cast<double>(count)));
    std::vector<Vec2> best;
    for (int step = 0; step < 30; ++step) {
        const double spacing = step == 0 ? 0.25 * high : 0.5 * (low + high);
        std::vector<Vec2> outline = outline_points(region, spacing);
        const double own = 0.5 * spacing * spacing * static_cast<double>(outline.size());
        const double inside = kReached * std::max(area - own, 0.0) / (kHexagon * spacing * spacing);
        if (static_cast<double>(outline.size()) + inside >= static_cast<double>(count)) {
            low = spacing;
        } else {
            high = spacing;
        }
        if (low == spacing || best.size() >= count) best = std::move(outline);
        if (low > 0.0 && high - low < 1e-3 * high) break;
    }
    return best;
}

/// At most `wanted` points of the outline, as many as equal steps allow.
std::vector<Vec2> outline_of(const Region& region, std::size_t wanted) {
    if (wanted == 0) return {};
    double length = 0.0;
    for (const Contour& contour : region.contours) {
        for (std::size_t i = 0; i < contour.size(); ++i) {
            length += glm::distance(contour[i], contour[(i + 1) % contour.size()]);
        }
    }
    double low = 0.25 * length / static_cast<double>(wanted), high = length;
    std::vector<Vec2> best;
    for (int step = 0; step < 40 && high - low > 1e-4 * high; ++step) {
        const double spacing = std::sqrt(low * high);
        std::vector<Vec2> outline = outline_points(region, spacing);
        if (outline.size() > wanted) {
            low = spacing;
            continue;
        }
        high = spacing;
        if (outline.size() > best.size()) best = std::move(outline);
    }
    return best;
}

/// Adds points inside until there are `count`, spread evenly between those that stand.
void fill_up(std::vector<Vec2>& points, std::size_t count, const DensityRaster& raster, const Run& run) {
    const std::size_t fixed = points.size();
    if (fixed == count) return;
    const std::vector<Vec2> inside = spread_by_mass(raster, count - fixed);
    points.insert(points.end(), inside.begin(), inside.end());
    relax(points, fixed, raster, kLloydRounds, run);
    const double area = raster.total() * raster.cell * raster.cell;
    const std::size_t rounds = std::clamp(kPushWork / count, kPushRounds, kPushRoundsAtMost);
    push_apart(points, fixed, raster, std::sqrt(area / (kHexagon * static_cast<double>(count))), rounds, run);
}

/// Lloyd's rounds that leave as many sites in a place as its mass asks for.
void relax_by_density(std::vector<Vec2>& sites, std::size_t fixed, DensityRaster density, const Run& run) {
    relax(sites, fixed, density, kJumpingRounds, run);
    // Where the rounds come to rest, sites are as dense as the square root of the mass (Gersho 1979, in the plane).
    for (float& m : density.mass) m *= m;
    for (std::size_t round = kJumpingRounds; round < kLloydRounds; ++round) relax(sites, fixed, density, 1, run);
}

/// The region's cells, each with as much of the density as is inside.
DensityRaster weighed(const Region& region, std::size_t cells, const std::function<double(const Vec2&)>& density) {
    DensityRaster raster = rasterised(region, cells);
    for (std::size_t c = 0; c < raster.mass.size(); ++c) {
        if (raster.mass[c] <= 0.0F) continue;
        raster.mass[c] *=
            static_cast<float>(std::max(density(raster.centre(c % raster.across, c / raster.across)), 0.0));
    }
    return raster;
}

/// The share of the cells inside that would hold all mass were it as high everywhere as where the drones are.
double filled_share(const DensityRaster& raster, std::size_t cells_inside) {
    double sum = 0.0, squares = 0.0;
    for (const float m : raster.mass) {
        sum += static_cast<double>(m);
        squares += static_cast<double>(m) * static_cast<double>(m);
    }
    return squares > 0.0 ? sum * sum / squares / static_cast<double>(cells_inside) : 1.0;
}

}  // namespace

std::size_t cells_for(std::size_t count) {
    return std::clamp(kCellsPerPoint * count, kCellsAtLeast, kCellsAtMost);
}

std::vector<Vec2> sample_region(const Region& region, std::size_t count, std::optional<double> outline_share,
                                const Run& run) {
    AEROGRAM_REQUIRE(count >= 1);
    const DensityRaster raster = rasterised(region, cells_for(count));
    const double area = raster.total() * raster.cell * raster.cell;
    AEROGRAM_REQUIRE(area > 0.0);
    std::vector<Vec2> points =
        count == 1      ? std::vector<Vec2>{}
        : outline_share ? outline_of(region, static_cast<std::size_t>(*outline_share * static_cast<double>(count)))
                        : balanced_outline(region, area, count);
    if (points.size() > count) points.clear();  // too few drones for an outline
    fill_up(points, count, raster, run);
    return points;
}

std::vector<Vec2> sample_region(const Region& region, std::size_t count, std::optional<double> outline_share,
                                const std::function<double(const Vec2&)>& density, const Run& run) {
    AEROGRAM_REQUIRE(count >= 1);
    const std::size_t cells = cells_for(count);
    DensityRaster raster = weighed(region, cells, density);
    const double wanted = std::min(static_cast<double>(cells) / filled_share(raster, cells), kMostCellsByDensity);
    if (wanted > 2.0 * static_cast<double>(cells)) raster = weighed(region, static_cast<std::size_t>(wanted), density);
    if (raster.total() <= 0.0) raster = rasterised(region, cells);
    std::vector<Vec2> points;
    if (outline_share && count > 1)
        points = outline_of(region, static_cast<std::size_t>(*outline_share * static_cast<double>(count)));
    std::erase_if(points, [&](const Vec2& p) { return density(p) <= 0.0; });
    const std::size_t fixed = points.size();
    if (fixed == count) return points;
    const std::vector<Vec2> inside = spread_by_mass(raster, count - fixed);
    points.insert(points.end(), inside.begin(), inside.end());
    relax_by_density(points, fixed, std::move(raster), run);
    return points;
}

std::vector<Vec2> sample_evenly(const DensityRaster& area, std::size_t count, const Run& run) {
    AEROGRAM_REQUIRE(count >= 1);
    std::vector<Vec2> points;
    fill_up(points, count, area, run);
    return points;
}

std::vector<Vec2> sample_density(const DensityRaster& density, std::size_t count, const Run& run) {
    AEROGRAM_REQUIRE(count >= 1);
    std::vector<Vec2> points = spread_by_mass(density, count);
    relax_by_density(points, 0, density, run);
    return points;
}

}  // namespace aerogram::planner
