#pragma once
#include <cstdint>
#include <utility>
#include <vector>

#include "export/verify/slab.hpp"

namespace aerogram::exporter {

/// Every pair (first < second) of boxes less than `reach_m` apart, by a uniform hash grid; each once, in a fixed order.
/// @param mean_extent_m  of the boxes; sets the grid's cell.
/// Cost: O(n log n + pairs) when few boxes are much larger than the mean.
class CloseBoxes {
  public:
    const std::vector<std::pair<std::uint32_t, std::uint32_t>>& find(const std::vector<Box>& boxes, double reach_m,
                                                                     double mean_extent_m);

  private:
    struct Entry {
        std::uint64_t cell = 0;
        std::uint32_t box = 0;
        auto operator<=>(const Entry&) const = default;
    };
    std::vector<Entry> entries_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs_;
};

}  // namespace aerogram::exporter
