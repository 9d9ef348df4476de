#pragma once
#include <compare>
#include <cstdint>
#include <functional>
#include <vector>

#include "export/verify/slab.hpp"

namespace aerogram::exporter {

/// Pairs of close boxes by a uniform hash grid, whose memory is reused.
class CloseBoxes {
  public:
    /// Takes a pair, first < second; false ends the search.
    using Visit = std::function<bool(std::uint32_t first, std::uint32_t second)>;

    /// Visits every pair of boxes less than `reach_m` apart; each once, in a fixed order.
    /// @param boxes  finite.
    /// @param reach_m  >= 0; at 0 there is nothing to find.
    /// @param mean_extent_m  of the boxes; sets the grid's cell, together with floors that keep cells countable when
    ///     reach and boxes are next to nothing.
    /// Cost: O(n log n + pairs) when few boxes are much larger than the mean.
    void find(const std::vector<Box>& boxes, double reach_m, double mean_extent_m, const Visit& visit);

  private:
    struct Entry {
        std::uint64_t cell = 0;
        std::uint32_t box = 0;
        auto operator<=>(const Entry&) const = default;
    };
    std::vector<Entry> entries_;
};

}  // namespace aerogram::exporter
