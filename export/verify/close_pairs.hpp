#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "export/verify/slab.hpp"

namespace aerogram::exporter {

/// Pairs of close boxes by a uniform grid of their middles, whose memory is reused.
class CloseBoxes {
  public:
    /// Takes a pair, first < second; false ends the search.
    using Visit = std::function<bool(std::uint32_t first, std::uint32_t second)>;

    /// Visits every pair of boxes less than `reach_m` apart; each once, in a fixed order.
    /// @param boxes  finite.
    /// @param reach_m  >= 0; at 0 there is nothing to find.
    /// Cost: O(n log n + pairs): the few boxes much larger than the rest are compared with all.
    void find(const std::vector<Box>& boxes, double reach_m, const Visit& visit);

  private:
    struct Entry {
        std::uint64_t cell = 0;
        std::uint32_t box = 0;
        auto operator<=>(const Entry&) const = default;
    };
    /// Low and high corners in the order of the entries, coordinate by coordinate.
    using Corners = std::array<std::vector<double>, 6>;

    [[nodiscard]] double split_off_large(const std::vector<Box>& boxes);
    void enter(const std::vector<Box>& boxes, double cell_m);
    void order(const std::vector<Box>& boxes);
    bool visit_run(std::size_t entry, std::size_t begin, std::size_t end, double reach_m, const Visit& visit);

    std::vector<double> extents_m_;
    std::vector<std::uint32_t> small_, large_;
    std::vector<Entry> entries_;
    Corners corners_m_;
    std::vector<double> gaps2_m2_;
};

}  // namespace aerogram::exporter
