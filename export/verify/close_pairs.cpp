#include "export/verify/close_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geo/vectorized.hpp"

namespace aerogram::exporter {
namespace {

constexpr std::size_t kSmallShare = 256;  ///< one box of so many may be called large
constexpr double kSmallestCell_m = 1e-3;
constexpr unsigned kAxisBits = 20;
constexpr std::uint64_t kMostCells = (std::uint64_t{1} << kAxisBits) - 8;  ///< along an axis
constexpr std::uint64_t kMargin = 4;  ///< cells left free at an axis' ends: neighbours in one row are neighbours

constexpr std::uint64_t key_of(std::uint64_t x, std::uint64_t y, std::uint64_t z) {
    return (z << (2 * kAxisBits)) + (y << kAxisBits) + x;
}

double longest_side(const Box& box) {
    const Vec3 extent = box.high_m - box.low_m;
    return std::max({extent.x, extent.y, extent.z});
}

/// Squared gaps of one box to a run of others.
AEROGRAM_VECTORIZED void squared_gaps(const Box& box, const double* const* corners, std::size_t begin,
                                      std::size_t count, double* out) {
    const double *lx = corners[0] + begin, *ly = corners[1] + begin, *lz = corners[2] + begin;
    const double *hx = corners[3] + begin, *hy = corners[4] + begin, *hz = corners[5] + begin;
    const Vec3 low = box.low_m, high = box.high_m;
    for (std::size_t k = 0; k < count; ++k) {
        const double ax = lx[k] - high.x, bx = low.x - hx[k], ay = ly[k] - high.y, by = low.y - hy[k],
                     az = lz[k] - high.z, bz = low.z - hz[k];
        double x = ax > bx ? ax : bx, y = ay > by ? ay : by, z = az > bz ? az : bz;
        x = x > 0.0 ? x : 0.0;
        y = y > 0.0 ? y : 0.0;
        z = z > 0.0 ? z : 0.0;
        out[k] = x * x + y * y + z * z;
    }
}

}  // namespace

/// Sets the few large boxes apart from the small; @returns the longest side of the small ones.
double CloseBoxes::split_off_large(const std::vector<Box>& boxes) {
    extents_m_.clear();
    for (const Box& box : boxes) extents_m_.push_back(longest_side(box));
    std::vector<double>& sorted = gaps2_m2_;
    sorted = extents_m_;
    const std::size_t few = std::min(boxes.size() - 1, boxes.size() / kSmallShare + 4);
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() - 1 - few);
    std::nth_element(sorted.begin(), middle, sorted.end());
    const double largest_m = 2.0 * *middle;  // whoever is not much larger than most is not large
    small_.clear();
    large_.clear();
    double longest_m = 0.0;
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        const bool large = extents_m_[i] > largest_m;
        (large ? large_ : small_).push_back(i);
        if (!large) longest_m = std::max(longest_m, extents_m_[i]);
    }
    return longest_m;
}

/// Gives each small box the cell of its middle, in the order of cells.
void CloseBoxes::enter(const std::vector<Box>& boxes, double cell_m) {
    Vec3 low(std::numeric_limits<double>::infinity()), high(-std::numeric_limits<double>::infinity());
    for (const std::uint32_t i : small_) {
        const Vec3 middle = 0.5 * (boxes[i].low_m + boxes[i].high_m);
        low = glm::min(low, middle);
        high = glm::max(high, middle);
    }
    const Vec3 span = high - low;
    const double size_m = std::max(
        {cell_m, kSmallestCell_m, std::max({span.x, span.y, span.z}) / static_cast<double>(kMostCells - 2 * kMargin)});
    entries_.clear();
    for (const std::uint32_t i : small_) {
        const Vec3 place = (0.5 * (boxes[i].low_m + boxes[i].high_m) - low) / size_m;
        const auto along = [](double v) { return static_cast<std::uint64_t>(v) + kMargin; };
        entries_.push_back({key_of(along(place.x), along(place.y), along(place.z)), i});
    }
    std::sort(entries_.begin(), entries_.end());
}

void CloseBoxes::order(const std::vector<Box>& boxes) {
    for (auto& list : corners_m_) list.resize(entries_.size());
    for (std::size_t k = 0; k < entries_.size(); ++k) {
        const Box& box = boxes[entries_[k].box];
        for (int axis = 0; axis < 3; ++axis) {
            corners_m_[static_cast<std::size_t>(axis)][k] = box.low_m[axis];
            corners_m_[static_cast<std::size_t>(axis) + 3][k] = box.high_m[axis];
        }
    }
    gaps2_m2_.resize(entries_.size());
}

bool CloseBoxes::visit_run(std::size_t entry, std::size_t begin, std::size_t end, double reach_m, const Visit& visit) {
    if (begin >= end) return true;
    const std::array<const double*, 6> corners{corners_m_[0].data(), corners_m_[1].data(), corners_m_[2].data(),
                                               corners_m_[3].data(), corners_m_[4].data(), corners_m_[5].data()};
    const auto& c = corners_m_;
    const Box box{{c[0][entry], c[1][entry], c[2][entry]}, {c[3][entry], c[4][entry], c[5][entry]}};
    squared_gaps(box, corners.data(), begin, end - begin, gaps2_m2_.data());
    for (std::size_t k = begin; k < end; ++k) {
        if (gaps2_m2_[k - begin] >= reach_m * reach_m) continue;
        const auto [first, second] = std::minmax(entries_[entry].box, entries_[k].box);
        if (!visit(first, second)) return false;
    }
    return true;
}

// Middles of two small boxes that are less than the reach apart differ by less than reach and longest side along each
// axis, that is by at most two cells of half of that. A box looks at those after it in the order of cells: the rest of
// its row, and twelve rows of which windows slide along.
void CloseBoxes::find(const std::vector<Box>& boxes, double reach_m, const Visit& visit) {
    if (!(reach_m > 0.0) || boxes.size() < 2) return;  // no gap is below 0
    enter(boxes, 0.5 * (reach_m + split_off_large(boxes)));
    order(boxes);
    const std::size_t n = entries_.size();
    struct Window {
        std::uint64_t offset = 0;  ///< of the row's middle cell
        std::size_t begin = 0, end = 0;
    };
    std::vector<Window> rows;
    for (std::uint64_t y = 1; y <= 2; ++y) rows.push_back({key_of(0, y, 0)});
    for (std::uint64_t z = 1; z <= 2; ++z) {
        for (std::uint64_t y = 0; y <= 4; ++y) rows.push_back({key_of(0, y, z) - key_of(0, 2, 0)});
    }
    for (std::size_t i = 0, own_end = 0; i < n; ++i) {
        const std::uint64_t cell = entries_[i].cell;
        while (own_end < n && entries_[own_end].cell <= cell + 2) ++own_end;
        if (!visit_run(i, i + 1, own_end, reach_m, visit)) return;
        for (Window& row : rows) {
            while (row.begin < n && entries_[row.begin].cell < cell + row.offset - 2) ++row.begin;
            row.end = std::max(row.end, row.begin);
            while (row.end < n && entries_[row.end].cell <= cell + row.offset + 2) ++row.end;
            if (!visit_run(i, row.begin, row.end, reach_m, visit)) return;
        }
    }
    for (std::size_t a = 0; a < large_.size(); ++a) {
        for (std::uint32_t i = 0; i < boxes.size(); ++i) {
            const bool later_large = std::find(large_.begin(), large_.begin() + static_cast<std::ptrdiff_t>(a) + 1,
                                               i) != large_.begin() + static_cast<std::ptrdiff_t>(a) + 1;
            if (later_large || boxes[large_[a]].gap(boxes[i]) >= reach_m) continue;
            const auto [first, second] = std::minmax(large_[a], i);
            if (!visit(first, second)) return;
        }
    }
}

}  // namespace aerogram::exporter
