#include "export/verify/close_pairs.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace aerogram::exporter {
namespace {

constexpr double kCellsAcrossLargest = 32.0;
constexpr double kSmallestCell_m = 1e-3;
constexpr double kSmallestCellShare = 1e-9;  ///< of the farthest coordinate: cells are numbered within ±1e9

using Cell = std::array<std::int64_t, 3>;

Cell cell_at(const Vec3& p, double size) {
    const auto along = [size](double v) { return static_cast<std::int64_t>(std::floor(v / size)); };
    return {along(p.x), along(p.y), along(p.z)};
}

std::uint64_t cell_key(const Cell& cell) {
    std::uint64_t key = 0;
    for (const std::int64_t v : cell) {
        key = (key ^ static_cast<std::uint64_t>(v)) * 0x9E3779B97F4A7C15U;
        key ^= key >> 29U;
    }
    return key;
}

double cell_size(const std::vector<Box>& boxes, double reach_m, double mean_extent_m) {
    double largest = 0.0, farthest = 0.0;
    for (const Box& box : boxes) {
        const Vec3 extent = box.high_m - box.low_m, far = glm::max(glm::abs(box.low_m), glm::abs(box.high_m));
        largest = std::max({largest, extent.x, extent.y, extent.z});
        farthest = std::max({farthest, far.x, far.y, far.z});
    }
    return std::max({2.0 * (reach_m + mean_extent_m), largest / kCellsAcrossLargest, kSmallestCell_m,
                     kSmallestCellShare * farthest});
}

}  // namespace

// Each box grows by half the reach on all sides and is entered in all cells it touches. Two grown boxes that meet do so
// at the larger of their low corners, and the cell of that point alone reports the pair.
void CloseBoxes::find(const std::vector<Box>& boxes, double reach_m, double mean_extent_m, const Visit& visit) {
    entries_.clear();
    if (!(reach_m > 0.0)) return;  // no gap is below 0
    const double cell = cell_size(boxes, reach_m, mean_extent_m);
    const Vec3 half(0.5 * reach_m);
    const auto low_cell = [&](const Box& box) { return cell_at(box.low_m - half, cell); };
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        const Cell low = low_cell(boxes[i]), high = cell_at(boxes[i].high_m + half, cell);
        for (std::int64_t x = low[0]; x <= high[0]; ++x) {
            for (std::int64_t y = low[1]; y <= high[1]; ++y) {
                for (std::int64_t z = low[2]; z <= high[2]; ++z) entries_.push_back({cell_key({x, y, z}), i});
            }
        }
    }
    std::sort(entries_.begin(), entries_.end());
    entries_.erase(std::unique(entries_.begin(), entries_.end()), entries_.end());
    for (std::size_t begin = 0, end = 0; begin < entries_.size(); begin = end) {
        while (end < entries_.size() && entries_[end].cell == entries_[begin].cell) ++end;
        for (std::size_t a = begin; a < end; ++a) {
            const Box& first = boxes[entries_[a].box];
            for (std::size_t b = a + 1; b < end; ++b) {
                const Box& second = boxes[entries_[b].box];
                if (first.gap(second) >= reach_m) continue;
                const Cell p = low_cell(first), q = low_cell(second);
                const Cell meet{std::max(p[0], q[0]), std::max(p[1], q[1]), std::max(p[2], q[2])};
                if (cell_key(meet) != entries_[a].cell) continue;
                if (!visit(entries_[a].box, entries_[b].box)) return;
            }
        }
    }
}

}  // namespace aerogram::exporter
