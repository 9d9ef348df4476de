#include "export/verify/close_pairs.hpp"

#include <algorithm>
#include <cmath>

namespace aerogram::exporter {
namespace {

constexpr double kCellsAcrossLargest = 32.0;
constexpr double kSmallestCell_m = 1e-3;
constexpr double kSmallestCellShare = 1e-9;  ///< of the farthest coordinate: cells are numbered within ±1e9

std::uint64_t cell_key(double x, double y, double z) {
    std::uint64_t key = 0;
    for (const double v : {x, y, z}) {
        key = (key ^ static_cast<std::uint64_t>(static_cast<std::int64_t>(v))) * 0x9E3779B97F4A7C15U;
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
    const auto low_cell = [&](const Box& box) { return glm::floor((box.low_m - half) / cell); };
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        const Vec3 low = low_cell(boxes[i]), high = glm::floor((boxes[i].high_m + half) / cell);
        for (double x = low.x; x <= high.x; x += 1.0) {
            for (double y = low.y; y <= high.y; y += 1.0) {
                for (double z = low.z; z <= high.z; z += 1.0) entries_.push_back({cell_key(x, y, z), i});
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
                const Vec3 meet = glm::max(low_cell(first), low_cell(second));
                if (cell_key(meet.x, meet.y, meet.z) != entries_[a].cell) continue;
                if (!visit(entries_[a].box, entries_[b].box)) return;
            }
        }
    }
}

}  // namespace aerogram::exporter
