#include "planner/formation/image_contour.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "planner/picture/contours.hpp"
#include "planner/sampling/contour_track.hpp"

namespace aerogram::planner {
namespace {

constexpr std::size_t kMostCells = 1000;  ///< across
constexpr std::size_t kSmall = 256;       ///< pixels across: below, each pixel is four cells
constexpr double kDronesAtLeast = 2.0;    ///< on a contour

std::size_t rounded_up(std::size_t a, std::size_t b) {
    return (a + b - 1) / b;
}

/// Cells of step x step pixels: set where their mean brightness reaches the threshold.
Bitmap averaged(const SeenPicture& seen, double threshold, std::size_t step) {
    const std::size_t width = seen.picture.width, height = seen.picture.height;
    Bitmap out{rounded_up(width, step), rounded_up(height, step), {}};
    std::vector<double> sum(out.width * out.height, 0.0), count(sum.size(), 0.0), any(sum.size(), 0.0);
    for (std::size_t p = 0; p < seen.weight.size(); ++p) {
        const std::size_t cell = p / width / step * out.width + p % width / step;
        sum[cell] += seen.bright(p);
        count[cell] += 1.0;
        if (seen.weight[p] > 0.0F) any[cell] = 1.0;
    }
    for (std::size_t c = 0; c < sum.size(); ++c)
        out.set.push_back(sum[c] > 0.0 && sum[c] >= threshold * count[c] ? 1 : 0);
    if (std::count(out.set.begin(), out.set.end(), 1) > 0) return out;
    for (std::size_t c = 0; c < any.size(); ++c) out.set[c] = any[c] > 0.0 ? 1 : 0;  // specks that the mean hides
    return out;
}

Bitmap finer(const Bitmap& bitmap) {
    Bitmap out{2 * bitmap.width, 2 * bitmap.height, {}};
    out.set.reserve(4 * bitmap.set.size());
    for (std::size_t y = 0; y < out.height; ++y) {
        for (std::size_t x = 0; x < out.width; ++x) out.set.push_back(bitmap.set[y / 2 * bitmap.width + x / 2]);
    }
    return out;
}

/// Leaves out what is too short; returns how many.
std::size_t without_specks(Region& region, std::size_t count) {
    std::vector<double> lengths;
    for (const Contour& contour : region.contours) lengths.push_back(ContourTrack(contour).length());
    std::vector<std::size_t> order(lengths.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return lengths[a] > lengths[b]; });
    std::size_t kept = 0;
    double total = 0.0;
    for (; kept < order.size(); ++kept) {
        const double length = lengths[order[kept]];
        const double spacing = (total + length) / static_cast<double>(count);
        if (kept > 0 && length < kDronesAtLeast * spacing) break;
        total += length;
    }
    std::sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(kept));
    Region out;
    for (std::size_t k = 0; k < kept; ++k) out.contours.push_back(std::move(region.contours[order[k]]));
    region = std::move(out);
    return order.size() - kept;
}

}  // namespace

Result<ImageContour> image_contour(const SeenPicture& seen, double threshold, std::size_t count) {
    const std::size_t longer = std::max(seen.picture.width, seen.picture.height);
    const std::size_t step = rounded_up(longer, kMostCells);
    Bitmap bitmap = averaged(seen, threshold, step);
    ImageContour out;
    out.step = static_cast<double>(step);
    if (longer < kSmall) {
        bitmap = finer(bitmap);
        out.step = 0.5;
    }
    auto region = contours_of(bitmap, 0);
    if (!region) return region.error();
    out.region = std::move(*region);
    // The cells of the lowest row may reach beyond the picture.
    const double below = static_cast<double>(bitmap.height) * out.step - static_cast<double>(seen.picture.height);
    for (Contour& contour : out.region.contours) {
        for (Vec2& p : contour) p = p * out.step - Vec2(0.0, below);
    }
    out.specks = without_specks(out.region, count);
    return out;
}

}  // namespace aerogram::planner
