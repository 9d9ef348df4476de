#include "planner/formation/svg_points.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geo/contract.hpp"
#include "geo/units.hpp"
#include "planner/drawing/region_clip.hpp"
#include "planner/formation/svg_lines.hpp"
#include "planner/sampling/lloyd.hpp"
#include "planner/sampling/outline_points.hpp"
#include "planner/sampling/push_apart.hpp"
#include "planner/sampling/site_grid.hpp"

namespace aerogram::planner {
namespace {

constexpr std::size_t kCellsPerPoint = 64, kCellsAtLeast = 2'000, kCellsAtMost = 1'300'000;
constexpr std::size_t kLloydRounds = 20, kPushRounds = 240;
constexpr double kHexagon = 0.8660254037844386;  ///< area of a lattice's cell at spacing 1
constexpr double kReached = 0.86;                ///< share of the triangular lattice's density that points reach
constexpr double kLinesApart[] = {0.85, 0.6, 0.4, 0.2, 0.1};  ///< lines of different layers, spacings
constexpr double kLeastLeft = 0.6;                            ///< of a line's length
constexpr double kApart = 0.9;                                ///< outlines of different layers, spacings

bool on_lines(const InkLayer& layer) {
    return !layer.lines.lines.empty();
}

double area_of(const Region& region) {
    double sum = 0.0;
    for (const Contour& contour : region.contours) sum += 0.5 * doubled_area(contour);
    return std::max(sum, 0.0);
}

/// The outline points of one area, and how many there would be alone.
struct Outline {
    std::vector<Vec2> points;
    std::size_t alone = 0;
};

/// Of all areas at a spacing, upper ones first: a lower one's points near an upper one's are left out.
std::vector<Outline> outlines(const std::vector<InkLayer>& layers, double spacing) {
    std::vector<Outline> out(layers.size());
    std::vector<Vec2> accepted;
    std::vector<Bounds> boxes;
    for (std::size_t i = layers.size(); i-- > 0;) {
        if (on_lines(layers[i])) continue;
        std::vector<Vec2> own = outline_points(layers[i].area, spacing);
        out[i].alone = own.size();
        const SiteGrid near(accepted, spacing);
        const auto free = [&](const Vec2& p) {
            if (accepted.empty()) return true;
            return glm::distance(accepted[near.nearest(p)], p) >= kApart * spacing;
        };
        std::copy_if(own.begin(), own.end(), std::back_inserter(out[i].points), free);
        accepted.insert(accepted.end(), out[i].points.begin(), out[i].points.end());
    }
    return out;
}

/// How many drones each layer holds at a spacing.
std::vector<double> held(const std::vector<InkLayer>& layers, const std::vector<double>& size, double spacing,
                         bool outlined) {
    std::vector<double> out(layers.size());
    const std::vector<Outline> around = outlined ? outlines(layers, spacing) : std::vector<Outline>(layers.size());
    for (std::size_t i = 0; i < layers.size(); ++i) {
        if (on_lines(layers[i])) {
            out[i] = size[i] / spacing;
        } else {
            const double square = spacing * spacing;
            const double inside = std::max(size[i] - 0.5 * square * static_cast<double>(around[i].alone), 0.0);
            out[i] = static_cast<double>(around[i].points.size()) + kReached * inside / (kHexagon * square);
        }
    }
    return out;
}

/// Lengths of lines, areas of areas.
std::vector<double> sizes_of(const std::vector<InkLayer>& layers) {
    std::vector<double> out;
    for (const InkLayer& layer : layers) out.push_back(on_lines(layer) ? length_of(layer.lines) : area_of(layer.area));
    return out;
}

double spacing_for(const std::vector<InkLayer>& layers, const std::vector<double>& size, std::size_t count,
                   bool outlined) {
    double area = 0.0, length = 0.0;
    for (std::size_t i = 0; i < layers.size(); ++i) (on_lines(layers[i]) ? length : area) += size[i];
    const double n = static_cast<double>(count);
    double low = 0.0, high = 4.0 * std::sqrt(area / (kHexagon * n)) + 2.0 * length / n;
    for (int step = 0; step < 24; ++step) {
        const double spacing = step == 0 ? 0.25 * high : 0.5 * (low + high);
        const std::vector<double> now = held(layers, size, spacing, outlined);
        (std::accumulate(now.begin(), now.end(), 0.0) >= n ? low : high) = spacing;
        if (low > 0.0 && high - low < 2e-3 * high) break;
    }
    return high;
}

/// Whole numbers nearest to the shares of `count` (Hamilton's method: the largest remainders are rounded up).
std::vector<std::size_t> apportioned(const std::vector<double>& shares, std::size_t count) {
    const double total = std::accumulate(shares.begin(), shares.end(), 0.0);
    std::vector<std::size_t> out(shares.size()), order(shares.size());
    std::vector<double> rest(shares.size());
    std::size_t given = 0;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        const double exact = shares[i] / total * static_cast<double>(count);
        out[i] = static_cast<std::size_t>(exact);
        rest[i] = exact - std::floor(exact);
        given += out[i];
        order[i] = i;
    }
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return rest[a] != rest[b] ? rest[a] > rest[b] : a < b; });
    for (std::size_t k = 0; given < count; k = (k + 1) % order.size(), ++given) ++out[order[k]];
    while (given > count) {  // sums of doubles that rounded up
        auto most = std::max_element(out.begin(), out.end());
        --*most;
        --given;
    }
    return out;
}

DensityRaster raster_of(const Region& area, std::size_t count, const DensityField& density) {
    DensityRaster raster = rasterised(area, std::clamp(kCellsPerPoint * count, kCellsAtLeast, kCellsAtMost));
    if (!(raster.total() > 0.0)) std::fill(raster.mass.begin(), raster.mass.end(), 1.0F);  // thinner than any cell
    if (!density) return raster;
    const DensityRaster even = raster;
    for (std::size_t c = 0; c < raster.mass.size(); ++c) {
        const Vec2 at = raster.centre(c % raster.across, c / raster.across);
        raster.mass[c] *= static_cast<float>(std::max(density({at.x, 0.0, at.y}), 0.0));
    }
    return raster.total() > 0.0 ? raster : even;
}

/// Multiplies the areas by the mean density over them.
void weigh(std::vector<double>& size, const std::vector<InkLayer>& layers, const DensityField& density) {
    std::vector<double> weighed = size;
    for (std::size_t i = 0; i < layers.size(); ++i) {
        if (on_lines(layers[i])) continue;
        const DensityRaster even = raster_of(layers[i].area, 1, {});
        double mass = 0.0;
        for (std::size_t c = 0; c < even.mass.size(); ++c) {
            const Vec2 at = even.centre(c % even.across, c / even.across);
            mass += static_cast<double>(even.mass[c]) * std::max(density({at.x, 0.0, at.y}), 0.0);
        }
        weighed[i] *= mass / even.total();
    }
    if (std::accumulate(weighed.begin(), weighed.end(), 0.0) > 0.0) size = std::move(weighed);
}

/// `count` of the points, equally far apart in their order.
std::vector<Vec2> every_so_often(const std::vector<Vec2>& points, std::size_t count) {
    std::vector<Vec2> out;
    for (std::size_t k = 0; k < count; ++k) out.push_back(points[k * points.size() / count]);
    return out;
}

/// `count` points in an area of which `outline` are given; `others` stand already.
std::vector<Vec2> filled(const Region& area, std::size_t count, std::vector<Vec2> outline,
                         const std::vector<Vec2>& others, double spacing, const DensityField& density, const Run& run) {
    if (outline.size() == count) return outline;
    const DensityRaster raster = raster_of(area, count, density);
    const Bounds box = bounds_of(area);
    std::vector<Vec2> sites;
    for (const Vec2& p : others) {
        const bool near = p.x > box.low.x - spacing && p.y > box.low.y - spacing && p.x < box.high.x + spacing &&
                          p.y < box.high.y + spacing;
        if (near && std::find(outline.begin(), outline.end(), p) == outline.end()) sites.push_back(p);
    }
    const auto strangers = static_cast<std::ptrdiff_t>(sites.size());
    sites.insert(sites.end(), outline.begin(), outline.end());
    const std::size_t fixed = sites.size();
    const std::vector<Vec2> inside = spread_by_mass(raster, count - outline.size());
    sites.insert(sites.end(), inside.begin(), inside.end());
    relax(sites, fixed, raster, kLloydRounds, run);
    return {sites.begin() + strangers, sites.end()};
}

/// Lines without what is near to points that stand already: as many spacings around them as leave enough of the lines.
Chords clear_of(const Chords& lines, const std::vector<Vec2>& there, double spacing) {
    constexpr std::size_t kSides = 16;
    const Bounds box = bounds_of(Region{lines.lines});
    for (const double reach : kLinesApart) {
        Region discs;
        for (const Vec2& p : there) {
            if (glm::distance(p, glm::clamp(p, box.low, box.high)) > spacing) continue;
            Contour disc;
            for (std::size_t k = 0; k < kSides; ++k) {
                const double angle = 2.0 * kPi * static_cast<double>(k) / static_cast<double>(kSides);
                disc.push_back(p + reach * spacing * Vec2(std::cos(angle), std::sin(angle)));
            }
            discs.contours.push_back(std::move(disc));
        }
        if (discs.contours.empty()) return lines;
        auto left = clipped(lines, discs, Side::outside);
        if (left && length_of(*left) > kLeastLeft * length_of(lines)) return std::move(*left);
    }
    return lines;
}

/// Pushes points of areas apart; those of lines stay, and those of outlines too as long as that helps.
void push(std::vector<std::vector<Vec2>>& points, const std::vector<std::size_t>& standing,
          const std::vector<InkLayer>& layers, double spacing, const Run& run) {
    std::vector<Vec2*> order;  // lines, then outlines, then insides
    const auto take = [&](bool lines, bool stand) {
        for (std::size_t i = 0; i < layers.size(); ++i) {
            if (on_lines(layers[i]) != lines) continue;
            for (std::size_t k = 0; k < points[i].size(); ++k) {
                if ((k < standing[i]) == stand) order.push_back(&points[i][k]);
            }
        }
        return order.size();
    };
    const std::size_t lines = take(true, true), fixed = take(false, true);
    if (take(false, false) == lines) return;
    Region areas;
    for (std::size_t i = 0; i < layers.size(); ++i) {
        if (on_lines(layers[i]) || points[i].empty()) continue;
        areas.contours.insert(areas.contours.end(), layers[i].area.contours.begin(), layers[i].area.contours.end());
    }
    const DensityRaster raster = raster_of(areas, order.size(), {});
    const double ideal = spacing / std::sqrt(kReached);
    std::vector<Vec2> all;
    for (const Vec2* p : order) all.push_back(*p);
    push_apart(all, fixed, raster, ideal, kPushRounds, run);
    push_apart(all, lines, raster, ideal, kPushRounds, run);
    for (std::size_t k = 0; k < all.size(); ++k) *order[k] = all[k];
}

}  // namespace

LayerShares share_out(const std::vector<InkLayer>& layers, std::size_t count, std::optional<double> outline_share,
                      const DensityField& density) {
    AEROGRAM_REQUIRE(!layers.empty() && count >= 1, layers.size(), count);
    const bool outlined = outline_share.value_or(1.0) > 0.0 && !density;
    std::vector<double> size = sizes_of(layers);
    if (density) weigh(size, layers, density);
    LayerShares out;
    out.spacing = spacing_for(layers, size, count, outlined);
    out.count = apportioned(held(layers, size, out.spacing, outlined), count);
    return out;
}

std::vector<std::vector<Vec2>> layer_points(const std::vector<InkLayer>& layers, const std::vector<std::size_t>& count,
                                            std::optional<double> outline_share, const DensityField& density,
                                            const Run& run) {
    const std::size_t total = std::accumulate(count.begin(), count.end(), std::size_t{0});
    const bool outlined = outline_share.value_or(1.0) > 0.0 && !density;
    const double spacing = spacing_for(layers, sizes_of(layers), total, outlined);
    std::vector<Outline> around = outlined ? outlines(layers, spacing) : std::vector<Outline>(layers.size());
    std::vector<std::vector<Vec2>> out(layers.size());
    std::vector<std::size_t> standing(layers.size(), 0);
    std::vector<Vec2> there;  // on lines and outlines
    for (std::size_t i = layers.size(); i-- > 0;) {
        if (!on_lines(layers[i]) || count[i] == 0) continue;
        out[i] = line_points(clear_of(layers[i].lines, there, spacing), count[i], spacing);
        standing[i] = count[i];
        there.insert(there.end(), out[i].begin(), out[i].end());
    }
    if (!there.empty()) {
        const SiteGrid lines(there, spacing);
        for (Outline& outline : around) {
            std::erase_if(outline.points,
                          [&](const Vec2& p) { return glm::distance(there[lines.nearest(p)], p) < kApart * spacing; });
        }
    }
    for (std::size_t i = 0; i < layers.size(); ++i) {
        std::vector<Vec2>& own = around[i].points;
        const double most = outline_share ? *outline_share * static_cast<double>(count[i]) : 1e18;
        if (static_cast<double>(own.size()) > most) own = every_so_often(own, static_cast<std::size_t>(most));
        if (own.size() > count[i]) own.clear();  // too few drones for an outline
        if (!on_lines(layers[i])) standing[i] = own.size();
        there.insert(there.end(), own.begin(), own.end());
    }
    for (std::size_t i = 0; i < layers.size(); ++i) {
        if (on_lines(layers[i]) || count[i] == 0 || run.stopped()) continue;
        out[i] = filled(layers[i].area, count[i], around[i].points, there, spacing, density, run);
    }
    if (run.stopped()) {
        for (std::size_t i = 0; i < layers.size(); ++i) out[i].resize(count[i]);
        return out;
    }
    if (!density) push(out, standing, layers, spacing, run);
    return out;
}

std::vector<InkLayer> placed(const std::vector<InkLayer>& layers, const Vec2& middle, const Vec2& stretch) {
    std::vector<InkLayer> out = layers;
    for (InkLayer& layer : out) {
        for (auto* lines : {&layer.area.contours, &layer.lines.lines}) {
            for (auto& line : *lines) {
                for (Vec2& p : line) p = (p - middle) * stretch;
            }
        }
    }
    return out;
}

Bounds bounds_of(const std::vector<InkLayer>& layers) {
    Region all;
    for (const InkLayer& layer : layers) {
        const auto& lines = on_lines(layer) ? layer.lines.lines : layer.area.contours;
        all.contours.insert(all.contours.end(), lines.begin(), lines.end());
    }
    return bounds_of(all);
}

}  // namespace aerogram::planner
